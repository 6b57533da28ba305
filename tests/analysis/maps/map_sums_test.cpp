// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over grains and contacts in the cells of a map.
#include "analysis/frames/composition.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "analysis/stress/partial_stress.hpp"
#include "tests/analysis/contact_packings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace grseg {
namespace {

using std::numbers::pi;

/// Layers object with cells of the plane xy: a period of 10 along x, heights 0 to 10.
Layers map_of(double side_x, double side_y)
{
  return Layers::map(
      {MapPlane::xy, {periodic_axis('x', side_x, 10), open_axis('y', side_y, 0, 10)}, 1}, 10,
      std::nullopt);
}

/// Grains and contacts at random positions.
Packing disorder()
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0, 10);
  std::uniform_real_distribution<double> height(0, 9.5);  // so that no grain reaches beyond 10
  Packing packing;
  for (int g = 0; g < 60; ++g)
    packing.grain(g % 2 == 0 ? Species::small : Species::large, g % 2 == 0 ? 0.2 : 0.4,
                  {place(random), height(random)}, {place(random), place(random)}, place(random));
  for (int g = 0; g + 1 < 60; ++g) packing.contact(g, g + 1, {place(random) - 5, place(random)});
  packing.grain(Species::boundary, 1, {5, 0.5});
  packing.contact(3, 60, {1, 2});
  return packing;
}

/// Grains of diameter 1 on a square lattice, pressed by 3 N along both of its directions.
Packing lattice()
{
  constexpr int n = 10;
  Packing packing;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) packing.grain(Species::small, 0.5, {x + 0.5, y + 0.5}, {2, -1});
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      packing.image_contact(y * n + (x + 1) % n, y * n + x, {3, 0}, {1, 0});
      if (y > 0) packing.contact(y * n + x, (y - 1) * n + x, {0, 3});
    }
  return packing;
}

PartialContactStress<2> stress_in(const Layers& layers, const Packing& packing,
                                  Assignment assignment = Assignment::contact_point)
{
  PartialContactStress<2> stress(layers, assignment);
  stress.add(packing.grains, packing.frame);
  return stress;
}

KineticStress<2> motion_in(const Layers& layers, const Packing& packing)
{
  MeanVelocity<2> mean(layers, 1);
  mean.add(packing.grains, packing.frame);
  KineticStress<2> stress(layers, MeanFlow::layer, mean);
  stress.add(packing.grains, packing.frame);
  return stress;
}

void expect_same(const std::vector<double>& a, const std::vector<double>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-12 * (1 + std::abs(a[k])));
}

TEST(Map, ARowOfCellsHoldsTheContactsOfItsLayer)
{
  const auto packing = disorder();
  for (const auto assignment : {Assignment::contact_point, Assignment::grain}) {
    const auto by_layer = stress_in(unit_layers, packing, assignment);
    const auto by_cell = stress_in(map_of(0.7, 1), packing, assignment);
    ASSERT_EQ(by_cell.layers(), 15 * 10u);
    for (std::size_t n = 0; n < by_layer.layers(); ++n) {
      std::vector<double> sum(by_layer.row(0).size());
      for (std::size_t x = 0; x < 15; ++x) accumulate(sum, by_cell.row(n * 15 + x));
      expect_same(by_layer.row(n), sum);
    }
  }
}

TEST(Map, ARowOfCellsHoldsTheGrainsOfItsLayer)
{
  const auto packing = disorder();
  Composition<2> by_layer(unit_layers, GrainArea::centre),
      by_cell(map_of(0.7, 1), GrainArea::centre);
  by_layer.add(packing.grains, packing.frame);
  by_cell.add(packing.grains, packing.frame);
  for (std::size_t n = 0; n < by_layer.layers(); ++n) {
    std::vector<double> sum(2);
    for (std::size_t x = 0; x < 15; ++x) accumulate(sum, by_cell.mean(n * 15 + x));
    expect_same(by_layer.mean(n), sum);
  }
}

// Fluctuations about the cells' means plus the motion of the means make up the total kinetic energy.
TEST(Map, FluctuationsAndMeanFlowOfCellsMakeTheEnergyOfTheGrains)
{
  const auto packing = disorder();
  const auto motion = motion_in(map_of(3.3, 2), packing);
  double energy = 0, of_cells = 0;
  for (std::size_t g = 0; g < packing.grains.size(); ++g)
    if (is_mobile(packing.grains, g))
      energy += packing.grains.mass[g] * packing.frame.velocity[g].squaredNorm();
  for (std::size_t cell = 0; cell < motion.layers(); ++cell)
    for (const auto species : {Species::small, Species::large}) {
      const auto mean = motion.mean(cell, species);
      if (mean.mass > 0)
        of_cells +=
            mean.about_mean.kinetic.trace() + mean.mass * motion.velocity(cell).squaredNorm();
    }
  EXPECT_NEAR(of_cells, energy, 1e-12 * energy);
}

TEST(Map, AUniformBlockGivesAUniformMap)
{
  const auto packing = lattice();
  const auto map = map_of(2, 2);
  const auto stress = stress_in(map, packing);
  const auto motion = motion_in(map, packing);
  Composition<2> composition(map, GrainArea::centre);
  composition.add(packing.grains, packing.frame);
  ASSERT_EQ(stress.layers(), 25u);
  for (std::size_t cell = 5; cell < 25; ++cell) {  // there is nothing below the lowest grains
    auto sums = stress.mean(cell).sums;
    sums.volume = map.volume(cell);
    sums.content = composition.mean(cell);
    std::map<std::string, double> field;
    for (const auto& [name, value] : stress_fields(sums, two_sizes(1, 2), {})) field[name] = value;
    EXPECT_NEAR(field.at("nu"), pi / 4, 1e-14);
    EXPECT_EQ(field.at("phi_L"), 0);
    EXPECT_NEAR(field.at("pressure[N/m]"), 3, 1e-14);
    EXPECT_NEAR(field.at("sigma_yy[N/m]"), 3, 1e-14);
    EXPECT_NEAR(field.at("stress_ratio"), 0, 1e-14);
    const auto flow = flow_fields<2>(motion.velocity(cell), motion.mean(cell, Species::small));
    EXPECT_NEAR(flow.at(0).value, 0, 1e-14);
    EXPECT_NEAR(motion.flow(cell).u, 2, 1e-14);
    EXPECT_NEAR(motion.flow(cell).v, -1, 1e-14);
  }
}

// Two streams side by side in one layer: all their motion is mean flow of their cells.
TEST(Map, StreamsSideBySideAreFlowNotFluctuation)
{
  Packing packing;
  for (const double x : {1.5, 2.0, 6.5, 7.0})
    packing.grain(Species::small, 0.2, {x, 0.5}, {0, x < 5 ? 4.0 : -4.0});
  const auto cells = motion_in(map_of(5, 1), packing), layer = motion_in(unit_layers, packing);
  const double mass = 2 * pi * 0.04;
  EXPECT_NEAR(cells.velocity(0).y(), 4, 1e-14);
  EXPECT_NEAR(cells.velocity(1).y(), -4, 1e-14);
  EXPECT_NEAR(cells.mean(0, Species::small).about_mean.kinetic(1, 1), 0, 1e-14);
  EXPECT_NEAR(layer.mean(0, Species::small).about_mean.kinetic(1, 1), 2 * mass * 16, 1e-13);
}

TEST(Map, TheGranularTemperatureIsTheMeanSquarePerComponent)
{
  Packing packing;
  packing.grain(Species::small, 0.2, {1, 0.5}, {3, 4});
  packing.grain(Species::small, 0.2, {2, 0.5}, {-3, -4});
  const auto motion = motion_in(map_of(5, 1), packing);
  const auto flow = flow_fields<2>(motion.velocity(0), motion.mean(0, Species::small));
  EXPECT_EQ(flow.at(0).column, "T[m^2/s^2]");
  EXPECT_NEAR(flow.at(0).value, (9 + 16) / 2.0, 1e-13);
}

// The branch crosses the end of the period, and so the contact point is in the periodic image of the cell.
TEST(Map, AContactAcrossThePeriodCountsWhereItsPointComesInAgain)
{
  Packing packing;
  const auto left = packing.grain(Species::small, 0.5, {0.25, 1.5});
  const auto right = packing.grain(Species::small, 0.5, {9.25, 1.5});
  packing.image_contact(right, left, {-2, 0}, {-1, 0});  // touching at 9.75
  packing.image_contact(left, right, {2, 0}, {1, 0});    // the same contact, at -0.25
  const auto stress = stress_in(map_of(0.5, 1), packing);
  EXPECT_TRUE(same(stress.mean(20 + 19).sums.of(OwnSum::inside, 0), dyad({4, 0}, {1, 0})));
}

TEST(Map, AGrainAtAnEdgeCountsOnceInTheCellBehindIt)
{
  Packing packing;
  packing.grain(Species::small, 0.5, {4, 3});
  Composition<2> composition(map_of(2, 1), GrainArea::centre);
  composition.add(packing.grains, packing.frame);
  for (std::size_t cell = 0; cell < 50; ++cell)
    EXPECT_EQ(composition.mean(cell)[0], cell == 3 * 5 + 2 ? pi * 0.25 : 0) << cell;
}

// A ring of spheres, each pressing on the next one. At every contact, force and branch are along the
// circumference, so that all stress components but the first vanish; there is none across.
TEST(Map, ARingUnderHoopStressIsOneCellOfRz)
{
  constexpr std::size_t n = 12;
  const Vec2 axis{5, 4};
  const double radius = 3.3, chord = 2 * radius * std::sin(pi / n), force = 7;
  Grains grains;
  Frame<3> frame;
  for (std::size_t g = 0; g < n; ++g) {
    const double angle = 2 * pi * static_cast<double>(g) / n;
    grains.id.push_back(static_cast<std::int32_t>(g));
    grains.species.push_back(Species::small);
    grains.radius.push_back(chord / 2);
    grains.mass.push_back(1);
    grains.fixed.push_back(0);
    frame.position.emplace_back(axis.x() + radius * std::cos(angle),
                                axis.y() + radius * std::sin(angle), 2.5);
    frame.velocity.emplace_back(-std::sin(angle), std::cos(angle), 0.5);  // counter-clockwise
    frame.angular_velocity.emplace_back(Vec3::Zero());
  }
  for (std::size_t g = 0; g < n; ++g) {
    const Vec3 branch = frame.position[g] - frame.position[(g + 1) % n];
    frame.contacts.i.push_back(static_cast<std::int32_t>(g));
    frame.contacts.j.push_back(static_cast<std::int32_t>((g + 1) % n));
    frame.contacts.force.push_back(force / chord * branch);
    frame.contacts.branch.push_back(branch);
    frame.contacts.gap.push_back(0);
  }
  const auto rz = Layers::map(
      {MapPlane::rz, {open_axis('r', 1, 0, 5), periodic_axis('z', 2, 10)}, 1, axis}, 10, 10);
  PartialContactStress<3> stress(rz, Assignment::contact_point);
  stress.add(grains, frame);
  Tensor3 hoop = Tensor3::Zero();
  hoop(0, 0) = n * force * chord;
  const std::size_t at = 1 * 5 + 3;  // r from 3 to 4, z from 2 to 4
  for (std::size_t cell = 0; cell < stress.layers(); ++cell) {
    const Tensor3 expected = cell == at ? hoop : Tensor3::Zero();
    EXPECT_LT((stress.mean(cell).sums.of(OwnSum::inside, 0) - expected).norm(), 1e-12) << cell;
  }
  MeanVelocity<3> mean(rz, 1);
  mean.add(grains, frame);
  KineticStress<3> motion(rz, MeanFlow::layer, mean);
  motion.add(grains, frame);
  EXPECT_NEAR(motion.velocity(at).x(), -1, 1e-14);  // clockwise is positive
  EXPECT_NEAR(motion.velocity(at).y(), 0, 1e-14);
  const auto flow = flow_fields<3>(motion.velocity(at), motion.mean(at, Species::small));
  EXPECT_EQ(flow.at(0).column, "w[m/s]");
  EXPECT_NEAR(flow.at(0).value, 0.5, 1e-14);
  EXPECT_NEAR(flow.at(1).value, 0, 1e-14);
}

TEST(Map, SpeciesThatAreNotTwoHaveTheirNames)
{
  ContactSums<3> sums(3);
  sums.volume = 10;
  sums.content = {1, 2, 3};
  sums.of(OwnSum::inside, 0) = Vec3(10, 40, 70).asDiagonal();
  sums.of(OwnSum::inside, 0)(0, 1) = -10;
  const SpeciesList species{{"SE", 1}, {"AM", 2}, {"C", 3}};
  const auto fields = stress_fields(sums, species, {});
  const auto columns = columns_of(fields);
  EXPECT_EQ(columns, (std::vector<std::string>{"nu", "phi_SE", "phi_AM", "phi_C", "pressure[Pa]",
                                               "sigma_yy[Pa]", "stress_ratio"}));
  expect_same(values_of(fields), {0.6, 1 / 6.0, 1 / 3.0, 0.5, 4, 4, 0.25});
}

TEST(Map, AnEmptyCellHasNoRatios)
{
  ContactSums<2> sums;
  sums.volume = 1;
  const auto fields = stress_fields(sums, two_sizes(1, 2), {});
  EXPECT_EQ(fields[0].value, 0);
  EXPECT_TRUE(std::isnan(fields[1].value));
  EXPECT_EQ(fields[2].value, 0);
  EXPECT_TRUE(std::isnan(fields[4].value));
}

}  // namespace
}  // namespace grseg
