// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/bed_heights.hpp"

#include "analysis/frames/ratio.hpp"

#include <array>

namespace grseg {

BedHeights bed_heights(const Grains& grains, const Frame<2>& frame)
{
  std::array<double, 2> mass{}, moment{};
  double area = 0, area_moment = 0;  // over pi
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g)) continue;
    const auto species = static_cast<std::size_t>(grains.species[g]);
    const double y = frame.position[g].y(), square = grains.radius[g] * grains.radius[g];
    mass[species] += grains.mass[g];
    moment[species] += grains.mass[g] * y;
    area += square;
    area_moment += square * y;
  }
  return {.large = ratio(moment[1], mass[1]),
          .small = ratio(moment[0], mass[0]),
          .bed = 2 * ratio(area_moment, area)};
}

std::vector<Cell> cells(const BedHeights& heights)
{
  return {{"yL[m]", heights.large}, {"yS[m]", heights.small}, {"height[m]", heights.bed}};
}

}  // namespace grseg
