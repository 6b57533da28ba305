// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/hard_cases/case.hpp"
#include "tests/hard_cases/flows.hpp"
#include "tests/hard_cases/observed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// Quantities that a step must conserve or account for: energy, momentum, angular momentum.
namespace grseg::hard_cases {
namespace {

/// Exact energy balance of a step of the mid-point scheme: the work of gravity and of contact
/// impulses is computed with the mean of the velocities before and after the step.
struct EnergyBalance {
  double before = 0, after = 0;  // kinetic energy, J
  double gravity_work = 0;       // J
  double contact_work = 0;       // J

  double defect() const
  {
    return std::abs(after - before - gravity_work - contact_work) / std::max(before, after);
  }
};

EnergyBalance balance_of_a_step(Simulation<2>& simulation)
{
  const auto& world = simulation.world();
  const Velocities before(simulation);
  EnergyBalance balance;
  balance.before = kinetic_energy(simulation);
  Frame<2> frame;
  simulation.advance(frame);
  const Velocities after(simulation);
  balance.after = kinetic_energy(simulation);
  for (std::size_t g = 0; g < world.grains.size(); ++g) {
    const Vec2 mean = (before.velocity[g] + after.velocity[g]) / 2;
    balance.gravity_work += world.grains.mass[g] * world.step * world.gravity.dot(mean);
  }
  for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
    const SeenContact contact(world, frame.contacts, c);
    const Vec2 mean = (contact.relative(before) + contact.relative(after)) / 2;
    balance.contact_work += contact.impulse.dot(mean);
  }
  return balance;
}

TEST(Energy, EveryStepOfAFlowAccountsForItsEnergyToRoundOff)
{
  Case defects("H39", "energy that a step does not account for, relative");
  for (const double e : {0.25, 0.5, 0.75, 1.0}) {
    auto c = flow(8, 10, 0.5);
    c.world.material = {0.5, e};
    auto simulation = c.simulation();
    double largest = 0;
    for (int step = 0; step < 1500; ++step)
      largest = std::max(largest, balance_of_a_step(simulation).defect());
    defects.at_most(largest, 1e-12);
  }
}

TEST(Energy, ContactsOfAnInelasticFlowGiveNoEnergy)
{
  // This is not a law of physics: Newton's restitution may add energy in simultaneous impacts
  // (impacts_test.cpp), and at e = 1 a step of this flow gains 0.3 %. At e <= 1/2 friction and
  // impacts always dissipate more. A disc that is stopped while it rises at less than g h gains at
  // most m (g h)^2/8, which gravity removes in the same step.
  Case gains("H39", "largest work of contacts in a step at e ≤ 0.5, of m (g h)²/8");
  for (const double e : {0.25, 0.5}) {
    auto c = flow(8, 10, 0.5);
    c.world.material = {0.5, e};
    auto simulation = c.simulation();
    double mass = 0;
    for (const double m : c.world.grains.mass) mass += m;
    double most = -1, all = 0;
    for (int step = 0; step < 1500; ++step) {
      const auto b = balance_of_a_step(simulation);
      most = std::max(most, b.contact_work);
      all += b.contact_work;
    }
    const double lost_to_gravity =
        mass * c.world.gravity.squaredNorm() * c.world.step * c.world.step / 8;
    gains.at_most(std::max(most, 0.0) / lost_to_gravity, 1);
    EXPECT_LT(all, -kinetic_energy(simulation));
  }
}

struct Momenta {
  Vec2 linear = Vec2::Zero();  // linear momentum, kg m/s
  double angular = 0;          // angular momentum about the origin, kg m^2/s

  explicit Momenta(const Simulation<2>& s)
  {
    const auto& grains = s.world().grains;
    for (std::size_t g = 0; g < grains.size(); ++g) {
      const double m = grains.mass[g], r = grains.radius[g];
      const Vec2 x = s.position(g), v = s.velocity(g);
      linear += m * v;
      angular += m * (x.x() * v.y() - x.y() * v.x()) + m * r * r / 2 * s.angular_velocity(g);
    }
  }
};

/// A crowd of discs that collapses towards the middle of its initial lattice, for 1000 steps.
struct Collapse {
  Momenta start, end;
  double scale = 0;  // scale of the momenta that are summed, kg m/s
  double impulses = 0;

  static Simulation<2> begin(bool periodic)
  {
    auto c = crowd(8, 8, 1);
    c.world.box.periodic_x = periodic;
    c.world.material = {0.5, 0.5};
    for (std::size_t g = 0; g < c.position.size(); ++g)
      c.velocity[g] += 2 * (Vec2(4.8, 4.8) - c.position[g]);
    return c.simulation();
  }

  explicit Collapse(bool periodic) : Collapse(begin(periodic)) {}

  explicit Collapse(Simulation<2> simulation) : start(simulation), end(simulation)
  {
    for (std::size_t g = 0; g < simulation.world().grains.size(); ++g)
      scale += simulation.world().grains.mass[g] * simulation.velocity(g).norm();
    for (int step = 0; step < 1000; ++step)
      impulses += static_cast<double>(simulation.advance().force_bearing);
    end = Momenta(simulation);
  }
};

TEST(Momentum, ImpactsInAPeriodicGasConserveIt)
{
  const Collapse gas(true);
  EXPECT_GT(gas.impulses, 500);
  Case("H25", "momentum of a periodic gas, change over Σm|v|")
      .at_most((gas.end.linear - gas.start.linear).norm() / gas.scale, 1e-14);
}

TEST(Momentum, RoughImpactsInAnOpenCloudAlsoConserveAngularMomentum)
{
  // Lever arms add up to the distance of the centres, whether discs overlap or not.
  const Collapse cloud(false);
  EXPECT_GT(cloud.impulses, 500);
  Case("H25", "momentum of an open cloud, change over Σm|v|")
      .at_most((cloud.end.linear - cloud.start.linear).norm() / cloud.scale, 1e-14);
  const double lever = 5;  // distance from the origin, m
  Case("H25", "angular momentum of an open cloud, change over 5 m Σm|v|")
      .at_most(std::abs(cloud.end.angular - cloud.start.angular) / (cloud.scale * lever), 1e-14);
}

TEST(Momentum, WithoutFrictionEveryDiscKeepsItsSpin)
{
  Case spins("H26", "change of an angular velocity in a smooth flow, rad/s");
  for (const bool general : {false, true}) {
    auto c = flow(8, 8, 0.5);
    c.world.material = {0, 0.25};
    c.world.general = general;
    auto simulation = c.simulation();
    std::size_t contacts = 0;
    for (int step = 0; step < 1000; ++step) contacts += simulation.advance().force_bearing;
    EXPECT_GT(contacts, 5000u);
    for (std::size_t g = 0; g < c.spin.size(); ++g)
      spins.near(simulation.angular_velocity(g), c.spin[g], 1e-14);
  }
}

}  // namespace
}  // namespace grseg::hard_cases
