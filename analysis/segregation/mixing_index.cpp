// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/mixing_index.hpp"

#include "analysis/frames/composition.hpp"

#include <array>
#include <limits>

namespace grseg {

double mixing_index(const Layers& layers, const Grains& grains, const Frame<2>& frame)
{
  Composition composition(layers, GrainArea::centre);
  composition.add(grains, frame);
  std::array<double, 2> number{};
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g)) ++number[static_cast<std::size_t>(grains.species[g])];
  const auto all = composition.mean();
  const double area = all.small + all.large, phi = all.phi_large();
  if (!(phi > 0 && phi < 1)) return std::numeric_limits<double>::quiet_NaN();

  double variance = 0, occupied = 0;
  for (std::size_t n = 0; n < composition.layers(); ++n) {
    const auto here = composition.mean(n);
    const double own = here.small + here.large;
    if (!(own > 0)) continue;
    const double excess = here.phi_large() - phi;
    variance += own * excess * excess / area;
    ++occupied;
  }
  const double apart = phi * (1 - phi);
  const double of_one = (1 - phi) * all.large / number[1] + phi * all.small / number[0];
  const double random = occupied * apart * of_one / area;
  return (apart - variance) / (apart - random);
}

}  // namespace grseg
