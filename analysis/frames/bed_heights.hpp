// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/cells.hpp"
#include "formats/core/frame.hpp"

#include <limits>
#include <vector>

namespace grseg {

/// Heights of the bed, m; NaN where they are not known.
struct BedHeights {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  // y_L, y_S: centres of mass of the species, where there are two.
  double large = unknown, small = unknown;
  double bed = unknown;  // twice the mean height of the mobile grains' area or volume
};

/// Those of one frame; NaN for a species without mobile grains.
template <int D>
BedHeights bed_heights(const Grains& grains, const Frame<D>& frame);

/// The columns yL, yS and height.
std::vector<Cell> cells(const BedHeights& heights);

}  // namespace grseg
