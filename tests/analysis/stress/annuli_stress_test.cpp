// SPDX-License-Identifier: GPL-3.0-or-later
// Contact stress in annuli about an axis.
#include "analysis/frames/composition.hpp"
#include "tests/analysis/contact_packings.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace grseg {
namespace {

// A chain of grains under compression points at the axis: the stress across the annuli is the only
// component, whatever the direction of the chain.
TEST(AnnuliStress, ARadialChainPressesOutward)
{
  const Vec2 axis{5, 5};
  const auto annuli = Layers::annuli(1, 10, axis);
  for (const double angle : {0.0, 0.4, 2.0, 3.6, 5.5}) {
    const Vec2 outward{std::cos(angle), std::sin(angle)};
    Packing packing;
    const auto inner = packing.grain(Species::small, 0.5, axis + 2.25 * outward);
    const auto outer = packing.grain(Species::large, 1, axis + 3.75 * outward);
    packing.contact(outer, inner, 4 * outward);
    PartialContactStress<2> stress(annuli, Assignment::contact_point);
    stress.add(packing.grains, packing.frame);
    ASSERT_EQ(stress.layers(), 5u);
    EXPECT_TRUE(same(stress.mean(2).sums.of(PairSum::whole, 0), dyad({0, 4}, {0, 1.5})));
    PartialContactStress<2> by_grain(annuli, Assignment::grain);
    by_grain.add(packing.grains, packing.frame);
    EXPECT_TRUE(same(by_grain.mean(3).sums.of(PairSum::at_larger, 0), dyad({0, 4}, {0, 1.5})));
    EXPECT_TRUE(same(by_grain.mean(2).sums.of(PairSum::at_smaller, 0), dyad({0, 4}, {0, 1.5})));
  }
}

// Far from the axis an annulus is nearly a layer.
TEST(AnnuliStress, FarFromItsAxisIsThatOfLayers)
{
  const Packing packing = large_on_small();
  const auto annuli = Layers::annuli(1, 10, {5, -1e4});
  PartialContactStress<2> round(annuli, Assignment::contact_point);
  round.add(packing.grains, packing.frame);
  const auto flat = stress_of(packing, Assignment::contact_point).mean(1);
  const auto far = round.mean(10001);
  EXPECT_TRUE(same(far.sums.of(PairSum::whole, 0), flat.sums.of(PairSum::whole, 0), 1e-3));
  EXPECT_TRUE(same(far.sums.of(PairSum::by_size, 0), flat.sums.of(PairSum::by_size, 0), 1e-3));
}

TEST(AnnuliStress, PressureOfAllAnnuliIsThatOfAllLayers)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 10);
  Packing packing;
  for (int g = 0; g < 40; ++g)
    packing.grain(g % 2 == 0 ? Species::small : Species::large, g % 2 == 0 ? 0.2 : 0.4,
                  {place(random), place(random)});
  for (int g = 0; g + 1 < 40; ++g) packing.contact(g, g + 1, {place(random) - 5, place(random)});
  const auto trace_and_area = [&](const Layers& layers) {
    PartialContactStress<2> stress(layers, Assignment::contact_point);
    Composition<2> composition(layers, GrainArea::clipped);
    stress.add(packing.grains, packing.frame);
    composition.add(packing.grains, packing.frame);
    double trace = 0;
    for (std::size_t n = 0; n < stress.layers(); ++n)
      trace += stress.mean(n).sums.of(PairSum::whole, 0).trace();
    return std::array{trace, composition.mean()[0], composition.mean()[1]};
  };
  const auto flat = trace_and_area(unit_layers),
             round = trace_and_area(Layers::annuli(0.7, 10, {4, 6}));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(flat[k], round[k], 1e-11 * std::abs(flat[k]));
}

}  // namespace
}  // namespace grseg
