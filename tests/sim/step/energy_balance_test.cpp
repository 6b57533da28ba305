// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/energies.hpp"
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using worlds::Disc;

/// Two discs above a floor; the upper one spins and hits the lower one.
struct Impact {
  World<2> world = worlds::world_of({{{0, 0.4999}, 0.5}, {{0.3, 1.45}, 0.5}});
  Frame<2> frame;
  EnergyBalance balance;

  explicit Impact(double restitution)
  {
    world.gravity = {1, -9.8};
    world.material.restitution = restitution;
    world.walls = {worlds::floor_at(0)};
    Simulation<2> simulation(world, {{0, 0.4999}, {0.3, 1.45}});
    simulation.set_velocity(1, {0.2, -2}, 3);
    simulation.advance(frame);
    balance =
        energy_balance<2>(world.grains, frame, simulation.before(), world.gravity, world.step);
  }
};

TEST(EnergyBalance, ClosesToRoundOffOverAStepWithImpactsAndFriction)
{
  for (const double e : {0.0, 0.25, 1.0}) {
    const Impact impact(e);
    ASSERT_EQ(impact.frame.contacts.size(), 2u);
    EXPECT_LT(impact.balance.defect(), 1e-14);
    EXPECT_LT(impact.balance.work_of_contacts, 0);
  }
}

TEST(EnergyBalance, TheWorkOfGravityIsTheWeightTimesTheWay)
{
  auto world = worlds::world_of({{{0, 9}, 0.5}});
  world.gravity = {0, -9.8};
  Simulation<2> simulation(world, {{0, 9}});
  Frame<2> frame;
  simulation.advance(frame);
  const auto balance =
      energy_balance<2>(world.grains, frame, simulation.before(), world.gravity, world.step);
  EXPECT_NEAR(balance.work_of_gravity,
              world.grains.mass[0] * 9.8 * (9 - simulation.position(0).y()), 1e-12);
  EXPECT_EQ(balance.work_of_contacts, 0);
}

TEST(EnergyBalance, AForceThatIsMissingShowsAsADefect)
{
  Impact impact(0.25);
  auto without = impact.frame;
  without.contacts.force[1] *= 0.99;
  Simulation<2> simulation(impact.world, {{0, 0.4999}, {0.3, 1.45}});
  simulation.set_velocity(1, {0.2, -2}, 3);
  Frame<2> again;
  simulation.advance(again);
  const auto balance = energy_balance<2>(impact.world.grains, without, simulation.before(),
                                         impact.world.gravity, impact.world.step);
  EXPECT_GT(balance.defect(), 1e-4);
}

}  // namespace
}  // namespace grseg
