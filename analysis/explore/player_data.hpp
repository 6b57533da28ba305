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

/// Codes of 16 bits for numbers between two bounds: 65,535 equally spaced values, and one code for NaN.
class Quantisation {
 public:
  static constexpr std::uint16_t none = 65535, last = 65534;

  Quantisation() = default;
  Quantisation(double from, double to) : from_(from), to_(to) {}

  /// Widens the bounds so that `value` lies between them; NaN changes nothing.
  void include(double value)
  {
    if (std::isnan(value)) return;
    from_ = std::min(from_, value);
    to_ = std::max(to_, value);
  }
  double from() const { return is_empty() ? 0 : from_; }
  double to() const { return is_empty() ? 0 : to_; }
  /// Difference between the values of neighbouring codes. Coding a number changes it by at most half a step.
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

/// Packs a ShownRun for a page: positions and forces become codes of 16 bits, each
/// quantity with its own Quantisation. Adds to `arrays`
///
///   species (255: base), radius (m), row       by grain
///   x, y, and for spheres z                    by frame and grain; codes "x", "y", "z"
///   contact_offset                             by frame, and one entry more at the end: number of the
///                                              frame's first contact
///   i, j, along, across                        by contact. i: difference to the i of the previous
///                                              contact in the frame. j: wall w is 2^16 - 1 - w, or
///                                              2^32 - 1 - w if there are more than 2^15 grains
///   walls                                      by frame and wall: normal x, y, offset (m)
///
/// Returns the bounds of the codes, the numbers of grains and walls, and by frame time (s), step and
/// gravity (m/s^2).
nlohmann::ordered_json player_data(const ShownRun& run, const Box& box, BinaryArrays& arrays);

/// Upper bound of the size of these arrays, bytes, if `frames` frames are shown; for spheres an estimate.
double player_bytes(const TrajectoryReader& run, std::size_t frames);

}  // namespace grseg
