// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/mixing_index.hpp"

#include "analysis/frames/composition.hpp"

#include <array>
#include <limits>

namespace grseg {

template <int D>
double mixing_index(const Layers& layers, const Grains& grains, const Frame<D>& frame)
{
  Composition<D> composition(layers, GrainArea::centre);
  composition.add(grains, frame);
  std::array<double, 2> number{};
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, frame, g)) ++number[static_cast<std::size_t>(grains.species[g])];
  const auto all = composition.mean();
  const double volume = all[0] + all[1], phi = all[1] / volume;
  if (!(phi > 0 && phi < 1)) return std::numeric_limits<double>::quiet_NaN();

  double variance = 0, occupied = 0;
  for (std::size_t n = 0; n < composition.layers(); ++n) {
    const auto here = composition.mean(n);
    const double own = here[0] + here[1];
    if (!(own > 0)) continue;
    const double excess = here[1] / own - phi;
    variance += own * excess * excess / volume;
    ++occupied;
  }
  const double apart = phi * (1 - phi);
  const double of_one = (1 - phi) * all[1] / number[1] + phi * all[0] / number[0];
  const double random = occupied * apart * of_one / volume;
  return (apart - variance) / (apart - random);
}

template double mixing_index(const Layers&, const Grains&, const Frame<2>&);
template double mixing_index(const Layers&, const Grains&, const Frame<3>&);

}  // namespace grseg
