// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/reader.hpp"

#include <array>

namespace grseg {

/// The cell for three-dimensional viewers, the same for all frames so that a film does not jitter:
/// along x that of the run; along y, where nothing is periodic, from y = 0 or the lowest grain to
/// the height of the box or the highest grain of one frame; along z that of the run or, of discs,
/// one largest diameter about z = 0, where all centres are.
struct ViewCell {
  std::array<double, 3> low, high;  // m
  bool periodic_x, periodic_z;

  double length(std::size_t axis) const { return high[axis] - low[axis]; }
};

ViewCell view_cell(const TrajectoryReader& run, std::size_t frame);

}  // namespace grseg
