// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/bed_heights.hpp"

#include "analysis/frames/ratio.hpp"

#include <array>

namespace grseg {

template <int D>
BedHeights bed_heights(const Grains& grains, const Frame<D>& frame)
{
  std::array<double, 2> mass{}, moment{};
  double all = 0, all_moment = 0;  // areas over pi, or volumes over 4 pi/3
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    const auto species = static_cast<std::size_t>(grains.species[g]);
    const double y = frame.position[g].y(), radius = grains.radius[g];
    const double content = D == 2 ? radius * radius : radius * radius * radius;
    if (species < mass.size()) {
      mass[species] += grains.mass[g];
      moment[species] += grains.mass[g] * y;
    }
    all += content;
    all_moment += content * y;
  }
  return {.large = ratio(moment[1], mass[1]),
          .small = ratio(moment[0], mass[0]),
          .bed = 2 * ratio(all_moment, all)};
}

template BedHeights bed_heights(const Grains&, const Frame<2>&);
template BedHeights bed_heights(const Grains&, const Frame<3>&);

std::vector<Cell> cells(const BedHeights& heights)
{
  return {{"yL[m]", heights.large}, {"yS[m]", heights.small}, {"height[m]", heights.bed}};
}

}  // namespace grseg
