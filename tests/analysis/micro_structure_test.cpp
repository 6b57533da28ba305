// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro_structure.hpp"

#include "analysis/partial_contact_stress.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

const Layers unit_layers(1, 10);
const Layers one_layer(10, 10);

MicroStructure micro_of(const Scene& scene, const Layers& layers)
{
  MicroStructure micro(layers, GrainArea::clipped, 1, 2);
  micro.add(scene.grains, scene.frame);
  return micro;
}

double cell(const std::vector<double>& row, const std::string& name)
{
  const auto names = MicroStructure::columns();
  const auto found = std::find(names.begin(), names.end(), name);
  EXPECT_NE(found, names.end()) << name;
  return row.at(static_cast<std::size_t>(found - names.begin()));
}

TEST(MicroStructure, TheNeutralShareOfMixedContactsPeaksAtOneHalfForTwoThirdsLarge)
{
  EXPECT_NEAR(neutral_mixed_share(2.0 / 3, 2), 0.5, 1e-15);
  EXPECT_NEAR(neutral_mixed_share(0.5, 2), 4.0 / 9, 1e-15);
  EXPECT_NEAR(neutral_mixed_share(0.25, 2), 4 * 0.25 * 0.75 / (1.75 * 1.75), 1e-15);
  EXPECT_NEAR(neutral_mixed_share(0.3, 1), 2 * 0.3 * 0.7, 1e-15);
  EXPECT_EQ(neutral_mixed_share(0, 2), 0);
  EXPECT_EQ(neutral_mixed_share(1, 2), 0);
}

/// A pyramid: two large grains on the base, one small between them on top, all contacts loaded but
/// that between the large ones.
Scene pyramid()
{
  Scene scene;
  const auto base = scene.grain(Species::boundary, 1, {4, -1});
  const auto left = scene.grain(Species::large, 1, {4, 1});
  const auto right = scene.grain(Species::large, 1, {6, 1});
  const auto small = scene.grain(Species::small, 0.5, {5, 1 + std::sqrt(1.25)});
  scene.contact(left, base, {3, 4});
  scene.contact(left, small, {0, -2});
  scene.contact(small, right, {0, 4});
  scene.contact(left, right, {0, 0});
  return scene;
}

TEST(MicroStructure, EndsAreCountedOnGrainsAndOnlyUnderForce)
{
  const auto sums = micro_of(pyramid(), one_layer).mean();
  EXPECT_EQ(sums.grains, (std::array<double, 2>{1, 2}));
  EXPECT_EQ(sums.ends, (std::array<double, 2>{2, 3}));
  EXPECT_EQ(sums.contacts, (std::array<double, 5>{0, 2, 0, 0, 1}));
  EXPECT_EQ(sums.coordination(Species::small), 2);
  EXPECT_EQ(sums.coordination(Species::large), 1.5);
}

TEST(MicroStructure, TheMeanForceIsOverContactsWithAtLeastOneSuchGrain)
{
  const auto sums = micro_of(pyramid(), one_layer).mean();
  EXPECT_NEAR(sums.mean_force(Species::small), (2.0 + 4) / 2, 1e-15);
  EXPECT_NEAR(sums.mean_force(Species::large), (5.0 + 2 + 4) / 3, 1e-15);
  EXPECT_EQ(sums.mixed_share(), 1);  // base contacts do not count
}

TEST(MicroStructure, TheNormalPartIsPositiveInRepulsion)
{
  const auto sums = micro_of(pyramid(), one_layer).mean();
  EXPECT_NEAR(sums.normal[4], 4, 1e-15);
  EXPECT_NEAR(sums.normal[1], (2 + 4) * std::sqrt(1.25) / 1.5, 1e-14);
}

TEST(MicroStructure, EndsBelongToTheLayerOfTheGrainAndContactsToThatOfTheirPoint)
{
  const auto micro = micro_of(pyramid(), unit_layers);
  EXPECT_EQ(micro.mean(2).grains, (std::array<double, 2>{1, 0}));
  EXPECT_EQ(micro.mean(2).ends, (std::array<double, 2>{2, 0}));
  EXPECT_EQ(micro.mean(2).contacts[1], 0);
  EXPECT_EQ(micro.mean(1).contacts[1], 2);
  EXPECT_EQ(micro.mean(1).ends, (std::array<double, 2>{0, 3}));
  EXPECT_EQ(micro.mean(0).contacts[4], 1);
  EXPECT_TRUE(std::isnan(micro.mean(0).coordination(Species::large)));
}

TEST(MicroStructure, HeightsAreCentresOfMassAndTwiceTheMeanHeightOfTheArea)
{
  const double top = 1 + std::sqrt(1.25);
  const auto heights = micro_of(pyramid(), unit_layers).heights();
  EXPECT_NEAR(heights.large, 1, 1e-15);
  EXPECT_NEAR(heights.small, top, 1e-15);
  EXPECT_NEAR(heights.bed, 2 * (2 + 0.25 * top) / 2.25, 1e-14);
}

/// A square lattice of equal large grains of diameter 2, held by normal forces of different sizes.
Scene lattice(double tangential)
{
  Scene scene;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      scene.grain(Species::large, 1, {1.0 + 2 * column, 1.0 + 2 * row});
  for (std::int32_t g = 0; g < 9; ++g) {
    if (g % 3 < 2) scene.contact(g, g + 1, {-1.0 - 0.1 * g, tangential});
    if (g < 6) scene.contact(g, g + 3, {tangential, -2.0 - 0.3 * g});
  }
  return scene;
}

/// Half the trace of the stress in the volume of the grains.
double pressure_of(const Scene& scene)
{
  PartialContactStress stress(one_layer, Assignment::contact_point);
  Composition composition(one_layer, GrainArea::clipped);
  stress.add(scene.grains, scene.frame);
  composition.add(scene.grains, scene.frame);
  return stress.mean(0).sums.ll.trace() / 2 / composition.mean().large;
}

TEST(MicroStructure, ForEqualGrainsAndNormalForcesPiIsThePressureInTheGrains)
{
  const auto row = micro_of(lattice(0), one_layer).bed_row();
  EXPECT_NEAR(cell(row, "Pi_L[N/m]"), pressure_of(lattice(0)), 1e-14);
  EXPECT_NEAR(cell(row, "Pi[N/m]"), pressure_of(lattice(0)), 1e-14);
  EXPECT_EQ(cell(row, "Pi_S[N/m]"), 0);
  EXPECT_NEAR(cell(row, "Pi_L_printed[N/m]"), 2 * pressure_of(lattice(0)), 1e-14);
}

// Tangential forces push no grain apart, but count in the modulus.
TEST(MicroStructure, TangentialForcesRaisePiAboveThePressure)
{
  EXPECT_NEAR(pressure_of(lattice(0.5)), pressure_of(lattice(0)), 1e-14);
  const auto row = micro_of(lattice(0.5), one_layer).bed_row();
  EXPECT_GT(cell(row, "Pi_L[N/m]"), 1.01 * pressure_of(lattice(0.5)));
}

TEST(MicroStructure, PiIsMadeOfNominalDiametersAndComposition)
{
  const auto micro = micro_of(pyramid(), one_layer);
  const double pi = std::numbers::pi;
  const auto row = micro.bed_row();
  EXPECT_NEAR(cell(row, "phi_L"), 2 / 2.25, 1e-14);
  EXPECT_NEAR(cell(row, "Pi_S[N/m]"), (0.25 / 2.25) * 2 * 3 / (pi * 1), 1e-14);
  EXPECT_NEAR(cell(row, "Pi_L[N/m]"), (2 / 2.25) * 1.5 * (11.0 / 3) / (pi * 2), 1e-14);
}

TEST(MicroStructure, ResultsAreMeansPerFrame)
{
  const Scene scene = pyramid();
  Scene idle = scene;
  idle.frame.contacts = {};
  MicroStructure micro(one_layer, GrainArea::clipped, 1, 2);
  micro.add(scene.grains, scene.frame);
  micro.add(idle.grains, idle.frame);
  EXPECT_EQ(micro.mean(0).grains[1], 2);
  EXPECT_EQ(micro.mean(0).ends[1], 1.5);
  EXPECT_EQ(micro.mean(0).coordination(Species::large), 0.75);
  EXPECT_NEAR(micro.mean(0).mean_force(Species::small), 3, 1e-15);
  EXPECT_NEAR(micro.heights().large, 1, 1e-15);
}

TEST(MicroStructure, ColumnsAndNumbersAgreeInCount)
{
  const auto micro = micro_of(pyramid(), unit_layers);
  EXPECT_EQ(MicroStructure::columns().size(), micro.row(0).size());
  EXPECT_EQ(MicroStructure::columns().size(), micro.bed_row().size());
}

}  // namespace
}  // namespace grseg
