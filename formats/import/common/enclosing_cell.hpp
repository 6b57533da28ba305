// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

namespace grseg {

/// Sets the cell of a moment to one that encloses its grains along the axes that are not periodic.
/// For archives that state no cell; there must be grains.
inline void enclose_grains(ArchiveMoment& moment)
{
  const auto& grains = moment.grains;
  Vec3 low = grains.position.front(), high = low;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const Vec3 reach = Vec3::Constant(grains.radius.empty() ? 0 : grains.radius[g]);
    low = low.cwiseMin(grains.position[g] - reach);
    high = high.cwiseMax(grains.position[g] + reach);
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (moment.periodic[static_cast<std::size_t>(axis)]) continue;
    moment.low[axis] = low[axis];
    moment.high[axis] = high[axis];
    moment.cell[static_cast<std::size_t>(axis)] = CellSource::grains;
  }
}

}  // namespace grseg
