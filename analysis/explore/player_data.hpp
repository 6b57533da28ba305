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

/// Codes of 16 bits for numbers between two bounds: 65,535 equally spaced values, and a code for NaN.
class Quantisation {
 public:
  static constexpr std::uint16_t none = 65535, last = 65534;

  Quantisation() = default;
  Quantisation(double from, double to) : from_(from), to_(to) {}

  /// Widens the bounds to hold this number; NaN changes nothing.
  void include(double value)
  {
    if (std::isnan(value)) return;
    from_ = std::min(from_, value);
    to_ = std::max(to_, value);
  }
  double from() const { return is_empty() ? 0 : from_; }
  double to() const { return is_empty() ? 0 : to_; }
  /// Distance of two codes. A number differs from the value of its code by at most half of it.
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

/// Prepares a ShownRun for a page, with positions, radii in the plane and forces in 16 bits. Adds to `arrays`
///
///   species (255: base), radius (m), row       by grain
///   x, y, and of spheres cut_radius            by frame and grain: Quantisation "x", "y", "cut"
///   contact_offset                             by frame and once more: where its contacts begin
///   i, j, along, across                        by contact: i less the i of the contact before in its
///                                              frame; wall w has j = 2^16 - 1 - w, or 2^32 - 1 - w if
///                                              there are more than 2^15 grains; Quantisation "along",
///                                              "across"
///   walls                                      by frame and wall: normal x, y, offset (m)
///
/// and returns bounds of the codes, numbers of things, times (s), steps and gravity (m/s^2) by frame.
nlohmann::ordered_json player_data(const ShownRun& run, const Box& box, BinaryArrays& arrays);

/// Largest number of bytes of these arrays if `frames` frames are shown; for spheres an estimate.
double player_bytes(const TrajectoryReader& run, std::size_t frames);

}  // namespace grseg
