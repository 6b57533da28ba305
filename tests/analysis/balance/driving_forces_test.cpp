// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/balance_table.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

using std::numbers::pi;

constexpr double step = 1e-3;
const Vec2 gravity(0, -9);
const Layers unit_layers(1, 10);
const Kernel narrow(0.03);

/// Two columns of discs of radius 1/2 side by side on the base, one named large and one named
/// small. A force of `load` times a grain's weight presses on the large column.
Packing columns(int count, double load)
{
  const double weight = 9 * pi / 4;
  Packing scene;
  for (const auto species : {Species::large, Species::small}) {
    const double x = species == Species::large ? 2 : 6;
    const auto base = scene.grain(Species::boundary, 0.5, {x, -0.5});
    for (int n = 0; n < count; ++n) {
      scene.grain(species, 0.5, {x, n + 0.5});
      const double above = count - n + (species == Species::large ? load : 0);
      scene.contact(base + n + 1, base + n, {0, above * weight});
    }
  }
  // The load comes from a wall whose contact point is at the top of the large column.
  scene.wall_contact(count, 1, {0, -load * weight}, {0, -0.5});
  scene.frame.force.assign(scene.grains.size(), {0, 0});
  return scene;
}

/// Adds a contact whose force is not balanced and therefore moves both grains.
void push_apart(Packing& scene, std::int32_t i, std::int32_t j, const Vec2& force)
{
  scene.contact(i, j, force);
  scene.frame.force[static_cast<std::size_t>(i)] += force;
  scene.frame.force[static_cast<std::size_t>(j)] -= force;
}

MomentumBalance<2> balance_of(const std::vector<Packing>& frames, const Kernel& kernel = narrow)
{
  MomentumBalance<2> balance(unit_layers, kernel, gravity, step);
  for (const auto& scene : frames) balance.add(scene.grains, scene.frame);
  return balance;
}

/// Balance of two equal frames that are one second apart.
MomentumBalance<2> balance_of(const Packing& scene)
{
  Packing later = scene;
  later.frame.time = 1;
  return balance_of(std::vector{scene, later});
}

double cell(const MomentumBalance<2>& balance, std::size_t layer, const std::string& column)
{
  for (const auto& [name, value] : balance_cells(balance, two_sizes(1, 2), layer))
    if (name.substr(0, name.find('[')) == column) return value;
  ADD_FAILURE() << "no column " << column;
  return 0;
}

TEST(DrivingForces, ColumnsOfEqualWeightPushNeitherWay)
{
  const auto balance = balance_of(columns(10, 0));
  for (std::size_t n = 0; n < 10; ++n) {
    const auto of = driving_forces(balance, n);
    EXPECT_NEAR(of.phi, 0.5, 1e-14);
    EXPECT_NEAR(of.b, 0, 1e-13);
    EXPECT_NEAR(of.push, 0, 1e-13);
  }
}

// In layer n the weight above the middle of each column is 10 - n - 1/2; the large column also
// carries the load: psi = (w + p)/(2 w + p). The stress of the mixture decreases by its weight per
// height, 2 (9 pi/4)/V.
TEST(DrivingForces, ASpeciesThatBearsMoreThanItsShareIsPushedUpwards)
{
  constexpr double load = 3;
  const auto balance = balance_of(columns(10, load));
  for (std::size_t n = 0; n < 9; ++n) {  // in the topmost layer the load is not a stress from above
    const auto of = driving_forces(balance, n);
    const double above = 9.5 - static_cast<double>(n);
    const double psi = (above + load) / (2 * above + load);
    const double weight = 2 * 9 * pi / 4 / unit_layers.volume(0);
    EXPECT_NEAR(of.psi, psi, 1e-13);
    EXPECT_NEAR(of.b, 4 * (psi - 0.5), 1e-12);
    EXPECT_NEAR(of.push, (psi - 0.5) * weight, 1e-12);
    EXPECT_NEAR(of.drag, -of.push, 1e-12);  // nothing moves
    EXPECT_NEAR(of.scatter, 0, 1e-12);
    // Columns that do not touch have no interaction, hence no drag: the spread compensates the push.
    EXPECT_NEAR(of.spread, of.push, 1e-12);
  }
}

// Large grains are at rest among small ones that enter through the bottom of the layer: psi_K = 0,
// and the momentum that they bring through the edge, m v_y times the part of the kernel that crosses
// it in a step, is -K'.
TEST(DrivingForces, ASpeciesThatFluctuatesLessIsPushedTowardsTheHotSide)
{
  constexpr double w = 0.05, speed = 0.5;
  const auto below = [](double u) { return std::erfc(-u / w / std::numbers::sqrt2) / 2; };
  MomentumBalance<2> balance(unit_layers, Kernel(w), {}, step);
  Packing scene;
  scene.grain(Species::large, 0.1, {2, 1.5});
  for (const double sign : {-1, 1}) scene.grain(Species::small, 0.1, {4, 1.05}, {0, sign * speed});
  scene.frame.force.assign(3, {0, 0});
  balance.add(scene.grains, scene.frame);
  const auto of = driving_forces(balance, 1);
  const double way = speed * step, mass = pi / 100,
               in = mass * speed * (below(way - 0.05) - below(-way - 0.05)) / step /
                    unit_layers.volume(0);
  EXPECT_NEAR(of.phi, 1 / (1 + 2 * below(0.05)), 1e-14);
  EXPECT_EQ(of.psi_kinetic, 0);
  EXPECT_NEAR(of.b_kinetic, -1 / (1 - of.phi), 1e-13);
  EXPECT_NEAR(of.push_kinetic, -of.phi * in, 1e-12);
  EXPECT_TRUE(std::isnan(of.psi));  // there is no contact stress to share
  EXPECT_EQ(of.push, 0);
}

TEST(DrivingForces, TheInteractionIsSpreadDragAndScatter)
{
  auto scene = columns(10, 2);
  for (std::int32_t n = 1; n <= 10; ++n) push_apart(scene, n, n + 11, {-0.1 * n, 0.3 * n - 1});
  for (std::size_t g = 0; g < scene.grains.size(); ++g)
    if (scene.grains.fixed[g] == 0)
      scene.frame.velocity[g] = {0.1, 0.3 * static_cast<double>(g % 7) - 1};
  auto later = scene;
  later.frame.time = 2;
  for (auto& velocity : later.frame.velocity) velocity *= 1.5;
  const auto balance = balance_of({scene, later}, Kernel(0.4));
  for (std::size_t n = 0; n < 10; ++n) {
    const auto of = driving_forces(balance, n);
    const auto small = balance.mean(n, Species::small), large = balance.mean(n, Species::large);
    const double change_large = balance.change(n, Species::large).y();
    const double change =
        change_large - of.phi * (change_large + balance.change(n, Species::small).y());
    EXPECT_GT(std::abs(large.interaction.y()), 1e-3);
    EXPECT_GT(std::abs(of.push_kinetic), 1e-6);
    EXPECT_GT(std::abs(change), 1e-5);
    EXPECT_NEAR(of.spread + of.spread_kinetic + of.drag + of.scatter, large.interaction.y(), 1e-11);
    EXPECT_NEAR(of.drift, (1 - of.phi) * large.momentum.y() - of.phi * small.momentum.y(), 1e-14);
  }
}

// The large column is pushed up as above. Within two seconds it gains the velocity a, and the small column
// loses b. Half of the difference of these accelerations is relative to the mixture; drag holds back the
// rest of the push. No grain reaches an edge of its layer, so no momentum flows through edges.
TEST(DrivingForces, WhatThePushDoesNotAccelerateIsDrag)
{
  constexpr double load = 3, time = 2, a = 0.4, b = 0.1;
  const auto at_rest = columns(10, load);
  auto moving = at_rest;
  moving.frame.time = time;
  for (std::size_t g = 0; g < moving.grains.size(); ++g)
    if (moving.grains.fixed[g] == 0)
      moving.frame.velocity[g].y() = moving.grains.species[g] == Species::large ? a : -b;
  const auto balance = balance_of({at_rest, moving});
  const double density = pi / 4 / unit_layers.volume(0);  // density of each species
  for (std::size_t n = 0; n < 9; ++n) {
    const auto of = driving_forces(balance, n);
    const double above = 9.5 - static_cast<double>(n);
    const double push = ((above + load) / (2 * above + load) - 0.5) * 2 * 9 * density;
    const double drag = density * (a + b) / (2 * time) - push;
    const double drift = density * (a + b) / 4;  // mean over both frames
    EXPECT_NEAR(of.push, push, 1e-12);
    EXPECT_NEAR(of.push_kinetic, 0, 1e-15);
    EXPECT_NEAR(of.drag, drag, 1e-12);
    EXPECT_NEAR(of.drift, drift, 1e-14);
    EXPECT_NEAR(of.drag_rate(), -drag / drift, 1e-10);
    EXPECT_NEAR(of.scatter, -density * (a + b) / (2 * time),
                1e-12);  // forces are in balance in both frames
  }
}

TEST(DrivingForces, ALayerOfOneSpeciesHasNoDrivingForces)
{
  Packing scene;
  scene.grain(Species::small, 0.5, {1, 0.5});
  scene.frame.force.assign(1, {0, 0});
  const auto of = driving_forces(balance_of(scene), 0);
  for (const double force : {of.phi, of.b, of.b_kinetic, of.drag, of.scatter, of.drift})
    EXPECT_TRUE(std::isnan(force));
}

TEST(BalanceTable, ColumnsAndNumbersAgree)
{
  const auto balance = balance_of(columns(10, 3));
  const auto species = two_sizes(1, 2);
  EXPECT_EQ(columns_of(balance_cells(balance, species, std::nullopt)),
            columns_of(balance_cells(balance, species, 0)));
  const auto large = balance.mean(2, Species::large);
  EXPECT_EQ(cell(balance, 2, "rho_L"), large.density);
  EXPECT_EQ(cell(balance, 2, "Sc_L_yy"), large.contact_stress(1, 1));
  EXPECT_EQ(cell(balance, 2, "gravity_L_y"), large.gravity.y());
  EXPECT_EQ(cell(balance, 0, "base_S_y"), balance.mean(0, Species::small).base.y());
  EXPECT_EQ(cell(balance, 2, "residual_L_y"), large.residual().y());
  EXPECT_EQ(cell(balance, 2, "push"), driving_forces(balance, 2).push);
}

// Two grains of equal mass move apart: mean velocity (2, 0), fluctuations (0.3, 0.4) and the opposite.
TEST(BalanceTable, KineticStressCountsFromTheMeanOfBothSpecies)
{
  Packing scene;
  scene.grain(Species::small, 0.1, {1, 0.5}, {2.3, 0.4});
  scene.grain(Species::large, 0.1, {2, 0.5}, {1.7, -0.4});
  scene.frame.force.assign(2, {0, 0});
  const auto balance = balance_of(scene);
  const double density = pi / 100 / unit_layers.volume(0);
  for (const std::string species : {"S", "L"}) {
    EXPECT_NEAR(cell(balance, 0, "Sk_" + species + "_xx"), 0.09 * density, 1e-15);
    EXPECT_NEAR(cell(balance, 0, "Sk_" + species + "_xy"), 0.12 * density, 1e-15);
    EXPECT_NEAR(cell(balance, 0, "Sk_" + species + "_yy"), 0.16 * density, 1e-15);
  }
}

// Layers 2 to 7 are at least two diameters away from base and surface.
TEST(BalanceSummary, SaysWhichWayLargeGrainsArePushedInUnitsOfTheirWeight)
{
  BalanceSummary<2> summary(unit_layers, 1);
  EXPECT_EQ(summary.sentence(), "the balances close to 0.0e+00 of the largest term of each");
  double sum = 0, squares = 0;
  for (const double load : {2, 3, 4}) {
    summary.add(balance_of(columns(10, load)));
    double parts = 0;
    for (int n = 2; n < 8; ++n) parts += 2 * ((9.5 - n + load) / (2 * (9.5 - n) + load) - 0.5) / 6;
    sum += parts;
    squares += parts * parts;
  }
  const double mean = sum / 3, error = std::sqrt((squares / 3 - mean * mean) / 2);
  const auto expected = fmt::format("are pushed up by {:.2g} +- {:.1g} by contact", mean, error);
  EXPECT_NE(summary.sentence().find(expected), std::string::npos) << summary.sentence();
  // Nothing moves, so drag balances the push.
  const auto drag = fmt::format("and down by {:.2g} +- {:.1g} by drag", mean, error);
  EXPECT_NE(summary.sentence().find(drag), std::string::npos) << summary.sentence();
}

TEST(BalanceSummary, APushWithinTwoStandardErrorsIsNeitherWay)
{
  BalanceSummary<2> summary(unit_layers, 1);
  summary.add(balance_of(columns(10, 3)));
  summary.add(balance_of(columns(10, -3)));
  EXPECT_NE(summary.sentence().find("pushed neither way ("), std::string::npos)
      << summary.sentence();
}

TEST(BalanceSummary, ReportsTheLargestResidualOverItsLargestTerm)
{
  auto scene = columns(10, 0);
  push_apart(scene, 4, 15, {-9 * pi / 8, 0});
  scene.frame.force[4].y() += 9 * pi / 4 * 0.01;  // middle of layer 3, weight 1 there
  BalanceSummary<2> summary(unit_layers, 1);
  summary.add(balance_of(scene));
  EXPECT_EQ(summary.sentence(), "the balances close to 1.0e-02 of the largest term of each");
}

}  // namespace
}  // namespace grseg
