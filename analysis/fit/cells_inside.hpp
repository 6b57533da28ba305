// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_key.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace grseg {

/// Ends of a map where its bed goes on, along its two axes: all of a periodic axis, and the axis of
/// a drum at r = 0.
struct OpenEnds {
  std::array<bool, 2> periodic = {};
  bool at_axis = false;  // the first axis begins at r = 0
};

/// True for each row whose cell is inside the bed, for `--heights inside` of a map: no cell within
/// `margin` (m) of it is empty, or filled to less than half the median solid fraction, averaged over
/// windows. Beyond an end of the map that is not open there are no grains.
std::vector<bool> cells_inside(const std::vector<LayerSolid>& rows, const OpenEnds& ends,
                               double margin);

/// The range of distances from the axis (m), for `--heights inside` of annuli: without `margin` at
/// the surface and at the wall. The surface is where the innermost annulus with at least half the
/// median solid fraction, averaged over windows, begins; at the axis there is none, since the bed
/// goes on. The wall is where the outermost annulus would end if it were as full as the one inside
/// it.
HeightRange annuli_inside(const std::vector<LayerSolid>& annuli, double margin);

}  // namespace grseg
