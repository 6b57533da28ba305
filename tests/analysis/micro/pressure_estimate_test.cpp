// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/derived_quantities.hpp"
#include "analysis/micro/structure_sums.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "tests/analysis/grain_builder.hpp"
#include "tests/analysis/neutral_contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

const Layers one_layer(20, 20);
const ForceMeasure paper{ContactForce::modulus, ForceAverage::contacts};
const ForceMeasure exact{ContactForce::normal, ForceAverage::ends};

/// A chain of touching grains that ends on the base. Each species has one size; forces along the
/// chain have different magnitudes and directions.
StructureSums<2> chain(double tangential)
{
  Packing scene;
  Vec2 place{3, 1};
  auto before = scene.grain(Species::boundary, 1, {3, -1});
  auto radius_before = 1.0;
  for (int g = 0; g < 9; ++g) {
    const bool large = g % 4 < 2;
    const double radius = large ? 1 : 0.5, angle = 0.5 + 0.3 * g;
    const Vec2 n{std::cos(angle), std::sin(angle)}, t{-n.y(), n.x()};
    if (g > 0) place += (radius_before + radius) * n;
    const auto grain = scene.grain(large ? Species::large : Species::small, radius, place);
    const Vec2 force = g > 0 ? Vec2((1.0 + g * g % 5) * n + tangential * t) : Vec2(0.3, 2);
    scene.contact(grain, before, force);
    before = grain;
    radius_before = radius;
  }
  StructureByLayer<2> micro(one_layer, GrainArea::clipped);
  micro.add(scene.grains, scene.frame);
  return micro.mean();
}

// tr sigma^L = (1/V) sum of r f_n over contact ends on L.
TEST(PressureEstimate, OverEndsAndOfNormalForcesItIsThePressureOfEachSpecies)
{
  const auto sums = chain(0.7);
  const auto pi = estimate_pressure(sums, exact, 1, 2);
  const auto stress = sums.stress(PartitionRule{});
  EXPECT_NEAR(pi.small, stress.small().trace() / 2, 1e-14);
  EXPECT_NEAR(pi.large, stress.large().trace() / 2, 1e-14);
  EXPECT_NEAR(pi.total(), stress.total.trace() / 2, 1e-14);
}

// SS : LS : LL = 4 : 4 : 1 with forces 1, 1.5 and 1: f_S is (4 + 6)/8 over contacts and
// (8 + 6)/12 over ends.
TEST(PressureEstimate, ThePapersAverageOverContactsGivesTheSmallGrainsTooMuch)
{
  const auto neutral = neutral_contacts(0.5, 2);
  auto sums = neutral;
  // Mixed contacts with larger forces than contacts between small grains, as in the flow.
  auto& mixed = sums.pair[static_cast<std::size_t>(PairType::LS)];
  mixed.force *= 1.5;
  mixed.normal *= 1.5;
  mixed.stress *= 1.5;
  sums.mixed_size *= 1.5;
  const auto stress = sums.stress(PartitionRule{});
  EXPECT_NEAR(estimate_pressure(sums, exact, 1, 2).small, stress.small().trace() / 2, 1e-14);
  EXPECT_NEAR(estimate_pressure(sums, paper, 1, 2).small, 15.0 / 14 * stress.small().trace() / 2,
              1e-14);
}

// Tangential forces do not push grains apart, but they contribute to the magnitude of the force.
TEST(PressureEstimate, TangentialForcesRaiseTheEstimateFromModuli)
{
  const ForceMeasure moduli{ContactForce::modulus, ForceAverage::ends};
  const auto without = chain(0), with = chain(0.7);
  EXPECT_NEAR(estimate_pressure(with, exact, 1, 2).total(),
              estimate_pressure(without, exact, 1, 2).total(), 1e-14);
  EXPECT_GT(estimate_pressure(with, moduli, 1, 2).total(),
            1.01 * estimate_pressure(without, moduli, 1, 2).total());
}

TEST(PressureEstimate, AnAbsentSpeciesBearsNothing)
{
  Packing scene;
  scene.grain(Species::small, 0.5, {1, 1});
  scene.grain(Species::small, 0.5, {2, 1});
  scene.contact(0, 1, {-3, 0});
  StructureByLayer<2> micro(one_layer, GrainArea::clipped);
  micro.add(scene.grains, scene.frame);
  const auto pi = estimate_pressure(micro.mean(), paper, 1, 2);
  EXPECT_EQ(pi.large, 0);
  EXPECT_NEAR(pi.small, 3 / std::numbers::pi, 1e-15);
}

TEST(PressureEstimate, NeutralContactsHaveTheNeutralShareAndNoSegregation)
{
  for (const double size_ratio : {1.5, 2.0, 3.0})
    for (const double phi : {0.1, 0.5, 0.9}) {
      const auto sums = neutral_contacts(phi, size_ratio);
      EXPECT_NEAR(sums.phi_large(), phi, 1e-14);
      EXPECT_NEAR(sums.mixed_share(), neutral_mixed_share(phi, size_ratio), 1e-14);
      EXPECT_NEAR(sums.coordination(Species::large) / sums.coordination(Species::small), size_ratio,
                  1e-13);
      const auto stress = sums.stress(PartitionRule{});
      const double slope =
          partition_slope(stress.small().trace(), stress.large().trace(), sums.phi_large());
      EXPECT_NEAR(local_b(slope, phi), 0, 1e-12);
      const auto pi = estimate_pressure(sums, exact, 1, size_ratio);
      EXPECT_NEAR(local_b(partition_slope(pi.small, pi.large, phi), phi), 0, 1e-12);
    }
}

TEST(PressureEstimate, TheNeutralShareOfMixedContactsPeaksAtOneHalfForTwoThirdsLarge)
{
  EXPECT_NEAR(neutral_mixed_share(2.0 / 3, 2), 0.5, 1e-15);
  EXPECT_NEAR(neutral_mixed_share(0.5, 2), 4.0 / 9, 1e-15);
  EXPECT_NEAR(neutral_mixed_share(0.25, 2), 4 * 0.25 * 0.75 / (1.75 * 1.75), 1e-15);
  EXPECT_NEAR(neutral_mixed_share(0.3, 1), 2 * 0.3 * 0.7, 1e-15);
  EXPECT_EQ(neutral_mixed_share(0, 2), 0);
  EXPECT_EQ(neutral_mixed_share(1, 2), 0);
}

// psi_S/psi_L = (phi_S/phi_L) (1 - B phi_L)/(1 + B phi_S).
TEST(PressureEstimate, LocalBInvertsTheMixtureTheory)
{
  const double b = 0.2, phi = 0.3;
  const double small = (1 - phi) * (1 - b * phi), large = phi * (1 + b * (1 - phi));
  EXPECT_NEAR(local_b(partition_slope(small, large, phi), phi), b, 1e-15);
  EXPECT_TRUE(std::isnan(partition_slope(small, large, 1)));
}

}  // namespace
}  // namespace grseg
