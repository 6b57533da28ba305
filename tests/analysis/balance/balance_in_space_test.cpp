// SPDX-License-Identifier: GPL-3.0-or-later
// Momentum balances of spheres, for two and for more species.
#include "analysis/balance/balance_table.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>

namespace grseg {
namespace {

using Spheres = PackingOf<3>;

constexpr double time_step = 1e-3;
const Vec3 oblique(3, -9, 2);
const Layers slabs(1, 10, 7);
const Kernel smooth(0.2);

Species numbered(int k)
{
  return static_cast<Species>(k);
}

/// Sets the force on every grain to its weight plus its contact forces.
Spheres accelerated(Spheres scene, const Vec3& gravity)
{
  auto& force = scene.frame.force;
  force.clear();
  for (const double mass : scene.grains.mass) force.emplace_back(mass * gravity);
  const auto& list = scene.frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    force[static_cast<std::size_t>(list.i[k])] += list.force[k];
    if (list.j[k] >= 0) force[static_cast<std::size_t>(list.j[k])] -= list.force[k];
  }
  return scene;
}

/// Spheres of `species` species and a base, joined by contacts with random, mostly repulsive forces.
Spheres random_spheres(unsigned seed, int species = 2)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, 3), any(-1, 1);
  const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
  Spheres scene;
  for (int g = 0; g < 90; ++g) {
    const bool base = g < 5;
    const double radius = 0.1 + 0.1 * (g % species);
    const Vec3 position(3 * place(random), base ? -0.1 : place(random), 2 * place(random));
    scene.grain(base ? Species::boundary : numbered(g % species), radius, position,
                Vec3(2, 0, -0.5) + vector(), vector());
  }
  std::uniform_int_distribution<std::int32_t> mobile(5, 89), either(0, 89);
  for (int k = 0; k < 250; ++k) {
    const auto i = mobile(random), j = either(random);
    if (i == j) continue;
    const Vec3 branch = scene.frame.position[static_cast<std::size_t>(i)] -
                        scene.frame.position[static_cast<std::size_t>(j)];
    scene.contact(i, j, vector() + branch.normalized());
  }
  scene.wall_contact(7, 0, {0.3, 0.4, -0.2}, {0.1, 0.15, 0.05});
  return accelerated(scene, oblique);
}

MomentumBalance<3> balance_of_spheres(const std::vector<Spheres>& frames, std::size_t species = 2,
                                      const Vec3& gravity = oblique, const Kernel& kernel = smooth)
{
  MomentumBalance<3> balance(slabs, kernel, gravity, time_step, species);
  for (const auto& scene : frames) balance.add(scene.grains, scene.frame);
  return balance;
}

/// Largest residual of a species in a layer, divided by the largest term in this layer.
double worst_residual(const MomentumBalance<3>& balance, Species species)
{
  double worst = 0;
  for (std::size_t n = 0; n < balance.layers(); ++n) {
    const auto of = balance.mean(n, species);
    double largest = 0;
    for (const auto& term : {of.rate, of.gravity, of.contact, of.kinetic, of.interaction, of.base})
      largest = std::max(largest, term.cwiseAbs().maxCoeff());
    worst = std::max(worst, of.residual().cwiseAbs().maxCoeff() / largest);
  }
  return worst;
}

TEST(BalanceInSpace, ClosesForEachSpeciesUnderAnyForces)
{
  for (const int species : {1, 2, 3, 5}) {
    const auto balance = balance_of_spheres(
        {random_spheres(1, species)}, static_cast<std::size_t>(species), oblique, Kernel(0.3));
    for (int k = 0; k < species; ++k)
      EXPECT_LT(worst_residual(balance, numbered(k)), 1e-10) << species << ' ' << k;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto of = balance.mean(1, Species::small);
      EXPECT_GT(std::abs(of.contact[axis]), 1e-4);
      EXPECT_GT(std::abs(of.kinetic[axis]), 1e-7);
      EXPECT_EQ(std::abs(of.interaction[axis]) > 1e-4, species > 1);
      EXPECT_GT(std::abs(balance.mean(0, Species::small).base[axis]), 1e-4);
    }
  }
}

// Forces and weights with the axes y and z exchanged do not fit the motions.
TEST(BalanceInSpace, AWrongAxisIsLeftAsResidual)
{
  const auto scene = random_spheres(2);
  const Vec3 exchanged(oblique.x(), oblique.z(), oblique.y());
  const auto wrong_gravity = balance_of_spheres({scene}, 2, exchanged);
  for (const auto species : {Species::small, Species::large})
    for (std::size_t n = 0; n < 3; ++n) {
      const auto of = wrong_gravity.mean(n, species);
      EXPECT_LT((of.residual() - of.density * (oblique - exchanged)).norm(), 1e-12);
    }
  auto turned = scene;
  for (auto& force : turned.frame.contacts.force) std::swap(force.y(), force.z());
  EXPECT_GT(worst_residual(balance_of_spheres({turned}), Species::large), 0.01);
  auto flat = scene;
  for (auto& force : flat.frame.contacts.force) force.z() = 0;
  EXPECT_GT(worst_residual(balance_of_spheres({flat}), Species::large), 0.01);
}

// Layers are stacked along y: shifting everything along x and z changes nothing, and turning the
// flow about y turns all vectors.
TEST(BalanceInSpace, TurningTheFlowAboutTheNormalTurnsItsVectors)
{
  const auto scene = random_spheres(3);
  Tensor3 turn;
  turn << 0.6, 0, 0.8, 0, 1, 0, -0.8, 0, 0.6;
  auto turned = scene;
  const auto turn_all = [&](auto& vectors) {
    for (auto& vector : vectors) vector = turn * vector;
  };
  turn_all(turned.frame.position);
  turn_all(turned.frame.velocity);
  turn_all(turned.frame.force);
  turn_all(turned.frame.contacts.force);
  turn_all(turned.frame.contacts.branch);
  const auto a = balance_of_spheres({scene}), b = balance_of_spheres({turned}, 2, turn * oblique);
  ASSERT_EQ(a.layers(), b.layers());
  for (std::size_t n = 0; n < a.layers(); ++n)
    for (const auto species : {Species::small, Species::large}) {
      const auto here = a.mean(n, species), there = b.mean(n, species);
      EXPECT_LT((turn * here.rate - there.rate).norm(), 1e-11);
      EXPECT_LT((turn * here.contact - there.contact).norm(), 1e-13);
      EXPECT_LT((turn * here.interaction - there.interaction).norm(), 1e-13);
      EXPECT_LT((turn * here.kinetic - there.kinetic).norm(), 1e-11);
      EXPECT_TRUE(same(turn * here.contact_stress * turn.transpose(), there.contact_stress, 1e-13));
    }
}

/// Part of a Gaussian of width 0.2 centred at height y that lies above an edge.
double above(double edge, double y)
{
  return std::erfc((edge - y) / 0.2 / std::numbers::sqrt2) / 2;
}

// Two spheres push each other across the edge y = 1; the large one is above.
TEST(BalanceInSpace, TheTermsOfAPairAreThoseWorkedOutByHand)
{
  Spheres scene;
  const Vec3 n(2.0 / 3, 2.0 / 3, 1.0 / 3), force(0.3, 2, -0.7);
  const auto large = scene.grain(Species::large, 0.2, Vec3(1, 0.95, 3) + 0.2 * n);
  const auto small = scene.grain(Species::small, 0.1, Vec3(1, 0.95, 3) - 0.1 * n);
  scene.contact(large, small, force);
  const Vec3 weightless = Vec3::Zero();
  const auto balance = balance_of_spheres({accelerated(scene, weightless)}, 2, weightless);
  const double volume = 70, at_contact = above(1, 0.95);
  const double at_large = above(1, 0.95 + 0.4 / 3);
  EXPECT_EQ(slabs.volume(0), volume);
  const auto upper = balance.mean(1, Species::large), lower = balance.mean(1, Species::small);
  EXPECT_LT((upper.interaction - force * at_contact / volume).norm(), 1e-15);
  EXPECT_LT((lower.interaction + force * at_contact / volume).norm(), 1e-15);
  EXPECT_LT((upper.contact - force * (at_large - at_contact) / volume).norm(), 1e-15);
  const Tensor3 stress = upper.contact_stress + balance.mean(0, Species::large).contact_stress;
  EXPECT_TRUE(same(volume * stress, force * (0.2 * n).transpose()));
  const Tensor3 other = lower.contact_stress + balance.mean(0, Species::small).contact_stress;
  EXPECT_TRUE(same(volume * other, force * (0.1 * n).transpose()));
  EXPECT_NEAR(balance.mean(0, Species::small).density + lower.density,
              grain_volume<3>(0.1) / volume, 1e-17);
}

// Spheres of radius 1/2 on a fixed one, species in turn: the mean stress of a layer is the weight
// above its middle divided by Lx Lz.
TEST(BalanceInSpace, AColumnOfThreeSpeciesCarriesItsWeight)
{
  constexpr int count = 6;
  const double weight = 9 * grain_volume<3>(0.5), base_area = 70;
  Spheres scene;
  scene.grain(Species::boundary, 0.5, {5, -0.5, 2});
  for (int n = 0; n < count; ++n) scene.grain(numbered(n % 3), 0.5, {5, n + 0.5, 2});
  for (int n = 0; n < count; ++n) scene.contact(n + 1, n, {0, weight * (count - n), 0});
  const Vec3 down(0, -9, 0);
  const auto balance = balance_of_spheres({accelerated(scene, down)}, 3, down, Kernel(0.05));
  for (std::size_t n = 0; n < count; ++n) {
    SpeciesMomentum<3> all;
    for (int k = 0; k < 3; ++k) all += balance.mean(n, numbered(k));
    const double above_middle = weight * (count - 0.5 - static_cast<double>(n));
    EXPECT_NEAR(all.contact_stress(1, 1) * base_area, above_middle, 1e-12);
    EXPECT_NEAR(all.gravity.y() * slabs.volume(n), -weight, 1e-13);
    EXPECT_NEAR(all.base.y() * slabs.volume(n), n == 0 ? count * weight : 0, 1e-12);
    EXPECT_LT(all.interaction.norm(), 1e-15);
    EXPECT_LT(all.rate.norm(), 1e-14);
  }
}

std::map<std::string, double> cells_of_layer(const MomentumBalance<3>& balance,
                                             const SpeciesList& species, std::size_t layer)
{
  std::map<std::string, double> cells;
  for (const auto& [column, value] : balance_cells(balance, species, layer)) cells[column] = value;
  return cells;
}

TEST(BalanceInSpace, EveryNumberStandsUnderItsColumn)
{
  const auto scene = random_spheres(4);
  auto later = scene;
  later.frame.time = 1;
  const auto balance = balance_of_spheres({scene, later});
  const auto cells = cells_of_layer(balance, two_sizes(1, 2), 1);
  const auto large = balance.mean(1, Species::large), small = balance.mean(1, Species::small);
  EXPECT_EQ(cells.at("rho_L[kg/m^3]"), large.density);
  EXPECT_EQ(cells.at("jz_L[kg/(m^2 s)]"), large.momentum.z());
  EXPECT_EQ(cells.at("Sc_S_zx[Pa]"), small.contact_stress(2, 0));
  EXPECT_EQ(cells.at("Sc_S_yz[Pa]"), small.contact_stress(1, 2));
  EXPECT_EQ(cells.at("interaction_L_z[N/m^3]"), large.interaction.z());
  EXPECT_EQ(cells.at("gravity_S_y[N/m^3]"), small.gravity.y());
  EXPECT_EQ(cells.at("change_S_z[N/m^3]"), balance.change(1, Species::small).z());
  const auto of = driving_forces(balance, 1);
  EXPECT_GT(std::abs(of.push), 1e-4);
  EXPECT_EQ(cells.at("push[N/m^3]"), of.push);
  EXPECT_EQ(cells.at("B"), of.b);
  EXPECT_NEAR(of.spread + of.spread_kinetic + of.drag + of.scatter, large.interaction.y(), 1e-11);
  const Vec3 mean = (small.momentum + large.momentum) / (small.density + large.density);
  EXPECT_NEAR(cells.at("Sk_L_yz[Pa]"),
              large.momentum_flux(1, 2) - large.momentum.y() * mean.z() -
                  mean.y() * large.momentum.z() + large.density * mean.y() * mean.z(),
              1e-14);
}

TEST(BalanceInSpace, OtherSpeciesThanTwoStandUnderTheirNamesWithoutDrivingForces)
{
  const SpeciesList species{{"SE", 0.2}, {"AM", 0.4}, {"CB", 0.6}};
  const auto scene = random_spheres(5, 3);
  const auto balance = balance_of_spheres({scene}, 3);
  const auto cells = cells_of_layer(balance, species, 0);
  EXPECT_EQ(cells.at("base_CB_z[N/m^3]"), balance.mean(0, numbered(2)).base.z());
  EXPECT_EQ(cells.at("rho_SE[kg/m^3]"), balance.mean(0, numbered(0)).density);
  EXPECT_FALSE(cells.contains("B"));
  BalanceSummary<3> summary(slabs, 0.6);
  summary.add(balance);
  summary.add(balance);
  EXPECT_TRUE(summary.sentence().starts_with("the balances close to ")) << summary.sentence();
}

// Two of three species are treated as one: the forces between them then are a stress.
TEST(BalanceInSpace, SpeciesTakenTogetherHaveTheSumOfTheirBalances)
{
  const auto three = random_spheres(6, 3);
  auto two = three;
  for (auto& species : two.grains.species)
    if (species == numbered(2)) species = Species::large;
  const auto a = balance_of_spheres({three}, 3), b = balance_of_spheres({two}, 2);
  for (std::size_t n = 0; n < 3; ++n) {
    const auto first = a.mean(n, numbered(1)), second = a.mean(n, numbered(2));
    const auto together = b.mean(n, Species::large);
    EXPECT_LT((first.rate + second.rate - together.rate).norm(), 1e-11);
    EXPECT_LT((first.base + second.base - together.base).norm(), 1e-14);
    EXPECT_LT((first.contact + first.interaction + second.contact + second.interaction -
               together.contact - together.interaction)
                  .norm(),
              1e-13);
    EXPECT_TRUE(same(first.contact_stress + second.contact_stress, together.contact_stress, 1e-14));
  }
}

}  // namespace
}  // namespace grseg
