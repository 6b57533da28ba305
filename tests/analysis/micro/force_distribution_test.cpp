// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/force_distribution.hpp"

#include "analysis/micro/structure_sums.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

const Layers layers(2, 100);

/// Adds chains of grains of radius 1 at the given height, pressed by the given normal forces.
void chain(Packing& scene, double height, Species species, const std::vector<double>& forces)
{
  auto before = scene.grain(species, 1, {1, height});
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const auto next = scene.grain(species, 1, {3.0 + 2 * static_cast<double>(k), height});
    scene.contact(next, before, {forces[k], 0.3});
    before = next;
  }
}

ForceDistribution<2> distribution(const Packing& scene, ForceUnit unit, double width = 0.1)
{
  MeanNormalForce<2> mean(layers);
  mean.add(scene.grains, scene.frame);
  ForceDistribution<2> forces(layers, mean, unit, width);
  forces.add(scene.grains, scene.frame);
  return forces;
}

double cell(const std::vector<double>& row, const std::string& name)
{
  const auto names = ForceDistribution<2>::columns();
  return row.at(
      static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin()));
}

/// Row of the bin that contains x.
std::vector<double> bin(const std::vector<std::vector<double>>& rows, double x)
{
  for (const auto& row : rows)
    if (cell(row, "x0") <= x && x < cell(row, "x1")) return row;
  return {};
}

TEST(ForceDistribution, EqualForcesLieInTheBinThatBeginsAtTheMean)
{
  Packing scene;
  chain(scene, 1, Species::small, {7, 7, 7});
  const auto rows = distribution(scene, ForceUnit::layer).rows(0);
  ASSERT_EQ(rows.size(), ForceDistribution<2>::bins);
  EXPECT_EQ(cell(bin(rows, 1), "x0"), 1);
  EXPECT_EQ(cell(bin(rows, 1), "n_SS"), 3);
  EXPECT_NEAR(cell(bin(rows, 1), "P_SS"), 10, 1e-13);
  EXPECT_EQ(cell(bin(rows, 1), "tail_SS"), 1);
  EXPECT_EQ(cell(bin(rows, 1.15), "tail_SS"), 0);
  EXPECT_TRUE(std::isnan(cell(bin(rows, 1), "P_LL")));
}

// Contacts of small grains have the force 1, of large ones 3: the mean of the layer is 2.
TEST(ForceDistribution, TheUnitIsTheMeanOfTheLayerOrOfThePairType)
{
  Packing scene;
  chain(scene, 1, Species::small, {1, 1});
  chain(scene, 1.5, Species::large, {3, 3});
  const auto by_layer = distribution(scene, ForceUnit::layer).rows(0);
  EXPECT_EQ(cell(bin(by_layer, 0.55), "n_SS"), 2);
  EXPECT_EQ(cell(bin(by_layer, 1.55), "n_LL"), 2);
  const auto by_type = distribution(scene, ForceUnit::type).rows(0);
  EXPECT_EQ(cell(bin(by_type, 1), "n_SS"), 2);
  EXPECT_EQ(cell(bin(by_type, 1), "n_LL"), 2);
}

TEST(ForceDistribution, EachLayerHasItsOwnMeanAndTheBedAllContacts)
{
  Packing scene;
  chain(scene, 1, Species::small, {5, 5});
  chain(scene, 3, Species::small, {1, 1});
  const auto forces = distribution(scene, ForceUnit::layer);
  EXPECT_EQ(cell(bin(forces.rows(0), 1), "n_SS"), 2);
  EXPECT_EQ(cell(bin(forces.rows(1), 1), "n_SS"), 2);
  EXPECT_EQ(cell(bin(forces.bed_rows(), 1), "n_SS"), 4);
}

TEST(ForceDistribution, TheDensityIntegratesToOneAndWhatIsBeyondLiesInTheOpenBin)
{
  Packing scene;
  chain(scene, 1, Species::small, {0.5, 0.7, 1, 1.3, 1.5});
  double integral = 0;
  for (const auto& row : distribution(scene, ForceUnit::layer).rows(0))
    if (std::isfinite(cell(row, "x1"))) integral += cell(row, "P_SS") * 0.1;
  EXPECT_NEAR(integral, 1, 1e-12);
  const auto narrow = distribution(scene, ForceUnit::layer, 0.01).rows(0);
  EXPECT_TRUE(std::isinf(cell(narrow.back(), "x1")));
  EXPECT_EQ(cell(narrow.back(), "n_SS"), 3);  // 1, 1.3 and 1.5 of a mean of 1
}

// Forces 1 and 3 on the base in a layer of their own: their mean is 2.
TEST(ForceDistribution, ContactsWithTheBaseAloneInALayerHaveBinsToo)
{
  Packing scene;
  for (const double force : {1.0, 3.0}) {
    const auto grain = scene.grain(Species::small, 0.5, {force, 0.5});
    scene.wall_contact(grain, 0, {0, force}, {0, 0.5});
  }
  const auto rows = distribution(scene, ForceUnit::layer).rows(0);
  EXPECT_EQ(cell(bin(rows, 0.55), "n_Sb"), 1);
  EXPECT_EQ(cell(bin(rows, 1.55), "n_Sb"), 1);
}

TEST(ForceDistribution, NoContactIsLostWhereForcesPullMoreThanTheyPush)
{
  Packing scene;
  chain(scene, 1, Species::small, {-3, 1, -2});
  for (const auto unit : {ForceUnit::layer, ForceUnit::type}) {
    const auto rows = distribution(scene, unit).rows(0);
    EXPECT_EQ(cell(rows.front(), "n_SS"), 2);
    EXPECT_EQ(cell(rows.back(), "n_SS"), 1);
  }
}

// The wall touches the lower grain above its top, through a gap, at y = 2.1. The layers are 2 thick.
TEST(ForceDistribution, AContactAboveAllGrainsOfItsFrameIsInTheLastLayerOfTheFrame)
{
  Packing high, low;
  chain(high, 5, Species::small, {1});
  const auto grain = low.grain(Species::small, 1, {1, 1});
  low.wall_contact(grain, 0, {0, -2}, {0, -1.1});
  StructureByLayer<2> structure(layers, GrainArea::centre, 0.5);
  MeanNormalForce<2> mean(layers);
  for (const auto& scene : {high, low}) {
    structure.add(scene.grains, scene.frame);
    mean.add(scene.grains, scene.frame);
  }
  EXPECT_EQ(structure.mean(0).of(PairType::Sb).contacts, 0.5);
  EXPECT_EQ(structure.mean(1).of(PairType::Sb).contacts, 0);
  EXPECT_EQ(mean.of(0, PairType::Sb), 2);
}

TEST(ForceDistribution, ContactsWithoutForceDoNotCount)
{
  Packing scene;
  chain(scene, 1, Species::small, {2, 2});
  scene.frame.contacts.force[0] = {0, 0};
  const auto rows = distribution(scene, ForceUnit::layer).rows(0);
  EXPECT_EQ(cell(bin(rows, 1), "n_SS"), 1);
  EXPECT_EQ(cell(rows[0], "n_SS"), 0);
}

TEST(ForceDistribution, CountsArePerFrameHoweverTheFramesAreMerged)
{
  Packing strong, weak;
  chain(strong, 1, Species::small, {3});
  chain(weak, 1, Species::small, {1});
  MeanNormalForce<2> mean(layers), more(layers);
  mean.add(strong.grains, strong.frame);
  more.add(weak.grains, weak.frame);
  mean.merge(more);
  EXPECT_EQ(mean.of(0, PairType::SS), 2);
  EXPECT_EQ(mean.of_layer(0), 2);
  ForceDistribution<2> first(layers, mean, ForceUnit::layer, 0.1), second = first;
  first.add(strong.grains, strong.frame);
  second.add(weak.grains, weak.frame);
  first.merge(second);
  EXPECT_EQ(cell(bin(first.rows(0), 1.55), "n_SS"), 0.5);
  EXPECT_EQ(cell(bin(first.rows(0), 0.55), "n_SS"), 0.5);
}

}  // namespace
}  // namespace grseg
