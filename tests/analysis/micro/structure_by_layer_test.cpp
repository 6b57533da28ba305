// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/structure_sums.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <tuple>

namespace grseg {
namespace {

const Layers unit_layers(1, 10);
const Layers one_layer(10, 10);

StructureByLayer<2> micro_of(const Packing& scene, const Layers& layers, double friction = 0.5)
{
  StructureByLayer<2> micro(layers, GrainArea::clipped, friction);
  micro.add(scene.grains, scene.frame);
  return micro;
}

/// A pyramid: two large grains on the base, and a small one between them on top. All contacts have
/// a force except the one between the large grains.
Packing pyramid()
{
  Packing scene;
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

TEST(StructureByLayer, EndsAreCountedOnGrainsAndOnlyUnderForce)
{
  const auto sums = micro_of(pyramid(), one_layer).mean();
  const auto &small = sums.of(Species::small), &large = sums.of(Species::large);
  EXPECT_EQ(small.grains, 1);
  EXPECT_EQ(small.ends, 2);
  EXPECT_EQ(small.mixed_ends, 2);
  EXPECT_EQ(small.base_ends, 0);
  EXPECT_EQ(large.grains, 2);
  EXPECT_EQ(large.ends, 3);
  EXPECT_EQ(large.mixed_ends, 2);
  EXPECT_EQ(large.base_ends, 1);
  EXPECT_EQ(sums.of(PairType::LS).contacts, 2);
  EXPECT_EQ(sums.of(PairType::LL).contacts, 0);
  EXPECT_EQ(sums.of(PairType::Lb).contacts, 1);
  EXPECT_EQ(sums.coordination(Species::small), 2);
  EXPECT_EQ(sums.coordination(Species::large), 1.5);
}

TEST(StructureByLayer, ThePapersMeanForceIsOverContactsWithAtLeastOneSuchGrain)
{
  const auto sums = micro_of(pyramid(), one_layer).mean();
  EXPECT_NEAR(sums.mean_force(Species::small, {}), (2.0 + 4) / 2, 1e-15);
  EXPECT_NEAR(sums.mean_force(Species::large, {}), (5.0 + 2 + 4) / 3, 1e-15);
  EXPECT_EQ(sums.mixed_share(), 1);  // base contacts do not count
}

TEST(StructureByLayer, AContactBetweenTwoLargeGrainsHasTwoEndsOnLargeGrains)
{
  Packing scene = pyramid();
  scene.frame.contacts.force[3] = {-3, 4};
  const auto sums = micro_of(scene, one_layer).mean();
  const ForceMeasure over_ends{ContactForce::modulus, ForceAverage::ends};
  EXPECT_NEAR(sums.mean_force(Species::large, over_ends), (5.0 + 2 + 4 + 5 + 5) / 5, 1e-15);
  EXPECT_NEAR(sums.mean_force(Species::large, {}), (5.0 + 2 + 4 + 5) / 4, 1e-15);
  EXPECT_NEAR(sums.mean_force(Species::small, over_ends), 3, 1e-15);
}

TEST(StructureByLayer, TheNormalPartIsPositiveInRepulsion)
{
  const auto sums = micro_of(pyramid(), one_layer).mean();
  EXPECT_NEAR(sums.of(PairType::Lb).normal, 4, 1e-15);
  EXPECT_NEAR(sums.of(PairType::LS).normal, (2 + 4) * std::sqrt(1.25) / 1.5, 1e-14);
  EXPECT_NEAR(sums.mean_force(Species::small, {ContactForce::normal, ForceAverage::contacts}),
              3 * std::sqrt(1.25) / 1.5, 1e-14);
}

TEST(StructureByLayer, EndsBelongToTheLayerOfTheGrainAndContactsToThatOfTheirPoint)
{
  const auto micro = micro_of(pyramid(), unit_layers);
  EXPECT_EQ(micro.mean(2).of(Species::small).grains, 1);
  EXPECT_EQ(micro.mean(2).of(Species::small).ends, 2);
  EXPECT_EQ(micro.mean(2).of(PairType::LS).contacts, 0);
  EXPECT_EQ(micro.mean(1).of(PairType::LS).contacts, 2);
  EXPECT_EQ(micro.mean(1).of(Species::large).ends, 3);
  EXPECT_EQ(micro.mean(0).of(PairType::Lb).contacts, 1);
  EXPECT_TRUE(std::isnan(micro.mean(0).coordination(Species::large)));
}

TEST(StructureByLayer, HeightsAreCentresOfMassAndTwiceTheMeanHeightOfTheArea)
{
  const double top = 1 + std::sqrt(1.25);
  const auto heights = micro_of(pyramid(), unit_layers).heights();
  EXPECT_NEAR(heights.large, 1, 1e-15);
  EXPECT_NEAR(heights.small, top, 1e-15);
  EXPECT_NEAR(heights.bed, 2 * (2 + 0.25 * top) / 2.25, 1e-14);
}

/// A hexagonal packing of equal large grains, periodic in both directions.
Packing hexagonal(const Vec2& along, const Vec2& up, const Vec2& down)
{
  Packing scene;
  constexpr std::int32_t columns = 4, rows = 4;
  const double rise = std::sqrt(3.0);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      scene.grain(Species::large, 1, {2.0 * column + row % 2, 1 + rise * row});
  const auto at = [](std::int32_t row, std::int32_t column) {
    return (row + rows) % rows * columns + (column + columns) % columns;
  };
  for (std::int32_t row = 0; row < rows; ++row)
    for (std::int32_t column = 0; column < columns; ++column) {
      const std::int32_t right = column + row % 2;  // the upper right neighbour
      scene.image_contact(at(row, column), at(row, column + 1), -along, {-2, 0});
      scene.image_contact(at(row, column), at(row + 1, right), -up, {-1, -rise});
      scene.image_contact(at(row, column), at(row + 1, right - 1), -down, {1, -rise});
    }
  return scene;
}

TEST(StructureByLayer, InAHexagonalPackingEveryGrainHasSixContactsWithoutADirection)
{
  const double half = 0.5, rise = std::sqrt(0.75);
  const auto sums = micro_of(hexagonal({1, 0}, {half, rise}, {-half, rise}), one_layer).mean();
  EXPECT_EQ(sums.coordination(Species::large), 6);
  const auto& contacts = sums.of(PairType::LL);
  EXPECT_NEAR(anisotropy(contacts.fabric, contacts.contacts, contacts.normal).a_c, 0, 1e-14);
  EXPECT_NEAR(principal_stress(contacts.stress).q, 0, 1e-13);
  EXPECT_EQ(contacts.strong, 0);
}

TEST(StructureByLayer, TheOrderOfTheGrainsInAContactDoesNotMatter)
{
  Packing scene, reversed;
  for (Packing* s : {&scene, &reversed}) {
    s->grain(Species::small, 0.5, {2, 1});
    s->grain(Species::large, 1, {2.9, 2.2});
  }
  scene.contact(0, 1, {-3, -1});
  reversed.contact(1, 0, {3, 1});
  const auto a = micro_of(scene, one_layer).mean().cells();
  const auto b = micro_of(reversed, one_layer).mean().cells();
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_NEAR(a[k].value, b[k].value, 1e-15) << a[k].column;
}

/// Sums for two grains side by side; `force` acts on the right one from the left.
StructureSums<2> pressed(const Vec2& force, double friction)
{
  Packing scene;
  scene.grain(Species::small, 1, {1, 1});
  scene.grain(Species::small, 1, {3, 1});
  scene.contact(1, 0, force);
  return micro_of(scene, one_layer, friction).mean();
}

TEST(StructureByLayer, AContactSlidesAtTheCoulombLimitAndNotBelow)
{
  EXPECT_EQ(pressed({2, 1}, 0.5).of(PairType::SS).sliding, 1);
  EXPECT_EQ(pressed({2, -1}, 0.5).of(PairType::SS).sliding, 1);
  EXPECT_EQ(pressed({2, 0.9999}, 0.5).of(PairType::SS).sliding, 0);
  EXPECT_EQ(pressed({2, 1}, 0.6).of(PairType::SS).sliding, 0);
  EXPECT_NEAR(pressed({2, -1}, 0.6).of(PairType::SS).mobilised, 0.5, 1e-15);
  EXPECT_EQ(pressed({-2, 1}, 0.5).of(PairType::SS).sliding, 0);  // a cohesive contact
}

TEST(StructureByLayer, WithoutAFrictionCoefficientSlidingIsUnknown)
{
  EXPECT_TRUE(std::isnan(pressed({2, 1}, std::nan("")).of(PairType::SS).sliding));
}

// Forces 1, 4 and 6 on three contacts of one layer: two exceed the mean.
TEST(StructureByLayer, AStrongContactBearsMoreThanTheMeanOfItsLayer)
{
  Packing scene;
  for (int g = 0; g < 4; ++g)
    scene.grain(g < 2 ? Species::small : Species::large, 1, {1.0 + 2 * g, 1});
  scene.contact(1, 0, {1, 0});
  scene.contact(2, 1, {4, 0});
  scene.contact(3, 2, {6, 0});
  const auto sums = micro_of(scene, one_layer).mean();
  EXPECT_EQ(sums.of(PairType::SS).strong, 0);
  EXPECT_EQ(sums.of(PairType::LS).strong, 1);
  EXPECT_EQ(sums.of(PairType::LL).strong, 1);
}

TEST(StructureByLayer, StressesAreThoseOfTheContactStressAtTheContactPoint)
{
  const auto scene = pyramid();
  const auto micro = micro_of(scene, unit_layers);
  PartialContactStress<2> stress(unit_layers, Assignment::contact_point);
  stress.add(scene.grains, scene.frame);
  for (std::size_t layer = 0; layer < micro.layers(); ++layer) {
    const auto sums = micro.mean(layer);
    const auto expected = stress.mean(layer).sums;
    EXPECT_TRUE(same(sums.of(PairType::LS).stress, expected.of(PairSum::whole, 0)));
    EXPECT_TRUE(same(sums.mixed_size, expected.of(PairSum::by_size, 0)));
    EXPECT_TRUE(same(sums.of(PairType::Lb).stress, expected.of(OwnSum::base, 1)));
  }
}

TEST(StructureByLayer, ResultsAreMeansPerFrame)
{
  const Packing scene = pyramid();
  Packing idle = scene;
  idle.frame.contacts = {};
  auto micro = micro_of(scene, one_layer);
  micro.add(idle.grains, idle.frame);
  EXPECT_EQ(micro.mean(0).of(Species::large).grains, 2);
  EXPECT_EQ(micro.mean(0).of(Species::large).ends, 1.5);
  EXPECT_EQ(micro.mean(0).coordination(Species::large), 0.75);
  EXPECT_NEAR(micro.mean(0).mean_force(Species::small, {}), 3, 1e-15);
  EXPECT_NEAR(micro.heights().large, 1, 1e-15);
  EXPECT_NEAR(micro.mean(0).phi_large(), 2 / 2.25, 1e-14);
}

TEST(StructureByLayer, MergedSumsAreThoseOfAllFrames)
{
  const Packing scene = pyramid();
  Packing lifted = scene;  // reaches into two more layers
  lifted.frame.position[3].y() += 2;
  lifted.frame.contacts.force[0] = {0, 0};
  auto whole = micro_of(scene, unit_layers), parts = whole;
  whole.add(lifted.grains, lifted.frame);
  parts.merge(micro_of(lifted, unit_layers));
  ASSERT_EQ(parts.layers(), whole.layers());
  for (std::size_t layer = 0; layer < whole.layers(); ++layer)
    EXPECT_EQ(values_of(parts.mean(layer).cells()), values_of(whole.mean(layer).cells())) << layer;
  EXPECT_EQ(parts.bed_row(), whole.bed_row());
}

// Column, its value in the layer of the two large grains, and its value for the whole bed.
TEST(StructureByLayer, EveryNumberStandsUnderItsColumn)
{
  const auto micro = micro_of(pyramid(), unit_layers);
  const auto columns = StructureByLayer<2>::columns();
  const auto layer = micro.row(1), bed = micro.bed_row();
  ASSERT_EQ(layer.size(), columns.size());
  ASSERT_EQ(bed.size(), columns.size());
  const auto at = [&](const char* column) {
    return std::find(columns.begin(), columns.end(), column) - columns.begin();
  };
  for (const auto& [column, in_layer, in_bed] :
       std::initializer_list<std::tuple<const char*, double, double>>{{"grains_S", 0, 1},
                                                                      {"grains_L", 2, 2},
                                                                      {"ends_L", 3, 3},
                                                                      {"ends_L_mixed", 2, 2},
                                                                      {"ends_L_base", 1, 1},
                                                                      {"n_LS", 2, 2},
                                                                      {"n_Lb", 0, 1},
                                                                      {"sum_f_LS[N]", 6, 6},
                                                                      {"M_xx[N m]", 0, 0},
                                                                      {"base_fx[N]", 0, 3},
                                                                      {"base_fy[N]", 0, 4}}) {
    ASSERT_LT(at(column), static_cast<std::ptrdiff_t>(columns.size())) << column;
    EXPECT_NEAR(layer[static_cast<std::size_t>(at(column))], in_layer, 1e-14) << column;
    EXPECT_NEAR(bed[static_cast<std::size_t>(at(column))], in_bed, 1e-14) << column;
  }
  EXPECT_TRUE(std::isnan(layer[static_cast<std::size_t>(at("yL[m]"))]));
  EXPECT_NEAR(bed[static_cast<std::size_t>(at("yL[m]"))], 1, 1e-15);
  EXPECT_NEAR(bed[static_cast<std::size_t>(at("yS[m]"))], 1 + std::sqrt(1.25), 1e-15);
}

}  // namespace
}  // namespace grseg
