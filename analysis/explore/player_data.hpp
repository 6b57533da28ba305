// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/explore/binary_arrays.hpp"
#include "analysis/explore/shown_run.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace grseg {

/// Numbers between two bounds in 16 bits: 65,535 equal steps, and a code for what is not a number.
class Quantisation {
 public:
  static constexpr std::uint16_t none = 65535, last = 65534;

  Quantisation() = default;
  Quantisation(double from, double to) : from_(from), to_(to) {}

  /// Bounds that hold this number, too; what is not a number changes nothing.
  void include(double value)
  {
    if (std::isnan(value)) return;
    from_ = std::min(from_, value);
    to_ = std::max(to_, value);
  }
  double from() const { return is_empty() ? 0 : from_; }
  double to() const { return is_empty() ? 0 : to_; }
  /// The width of a step; a number differs from what its code stands for by half of it at most.
  double step() const { return (to() - from()) / last; }

  std::uint16_t code(double value) const
  {
    if (std::isnan(value)) return none;
    if (!(step() > 0)) return 0;
    return static_cast<std::uint16_t>(
        std::clamp(std::round((value - from()) / step()), 0.0, static_cast<double>(last)));
  }

 private:
  bool is_empty() const { return from_ > to_; }

  double from_ = std::numeric_limits<double>::infinity();
  double to_ = -std::numeric_limits<double>::infinity();
};

/// A ShownRun for a page, positions, radii in the plane and forces in 16 bits. Adds to `arrays`
///
///   species (255: base), radius (m), row       by grain
///   x, y, and of spheres cut_radius            by frame and grain: Quantisation "x", "y", "cut"
///   contact_offset                             by frame and once more: where its contacts begin
///   i, j, along, across                        by contact: i less that of the contact before in its
///                                              frame; wall w has j = 2^16 - 1 - w, of more than 2^15
///                                              grains 2^32 - 1 - w; Quantisation "along", "across"
///   walls                                      by frame and wall: normal x, y, offset (m)
///
/// and returns what is needed to read them: bounds, numbers, times and gravity (m/s^2, by frame).
nlohmann::ordered_json player_data(const ShownRun& run, const Box& box, BinaryArrays& arrays);

/// Bytes of these arrays at most, where `frames` frames are shown; for spheres about as many.
double player_bytes(const TrajectoryReader& run, std::size_t frames);

}  // namespace grseg
