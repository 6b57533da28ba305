// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/solved_apart.hpp"
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

using namespace worlds;

/// A contact of a disc whose other body is in the direction `angle`, measured from the downward vertical.
Contact<2> at_angle(double angle)
{
  Contact<2> contact{};
  contact.n[0] = -std::sin(angle);
  contact.n[1] = std::cos(angle);
  contact.kappa = 1;
  return contact;
}

TEST(WedgedGrains, FrictionLocksADiscWhereItsConesHoldTheLineBetweenItsContacts)
{
  // The line between the contacts is horizontal and makes an angle of 90 degrees - a with both normals.
  const double a = 1.2, least = 1 / std::tan(a);
  EXPECT_TRUE(locks(at_angle(a), at_angle(-a), 1.001 * least));
  EXPECT_FALSE(locks(at_angle(a), at_angle(-a), 0.999 * least));
  EXPECT_FALSE(locks(at_angle(a), at_angle(a / 2), 0.999 * least));
}

/// A disc of radius 1/2 just above the gap between two fixed discs of radius 1, each `half` away
/// from the middle; it falls at speed 1.
struct OverAGap {
  std::vector<Disc> discs;
  World<2> world;
  double sine;  // sine of the angle between the line of centres and the horizontal
  explicit OverAGap(double half)
      : discs{{{-half, 0}, 1, true}, {{half, 0}, 1, true}, {{0, 0}, 0.5}},
        sine(std::sqrt(1.5 * 1.5 - half * half) / 1.5)
  {
    discs[2].position.y() = 1.5 * sine + 1e-4;
    world = world_of(discs);
    world.material = {0.5, 0.5};
    world.solver.max_sweeps = 100;
  }
};

TEST(WedgedGrains, ADiscThatFrictionLocksStopsInOneStepWithForcesThatItsMomentumMakes)
{
  // The tan of the angle between line and normals is 0.32, below mu = 0.5. Two forces along the
  // normals alone would be m v/(2 sine) each; friction carries a part.
  const OverAGap scene(1.43);
  Simulation<2> simulation(scene.world, positions_of(scene.discs));
  simulation.set_velocity(2, {0, -1});
  Frame<2> frame;
  const auto report = simulation.advance(frame);
  EXPECT_TRUE(report.solver.converged);
  EXPECT_NEAR(simulation.velocity(2).norm(), 0, 1e-9);
  const double momentum = scene.world.grains.mass[2], step = scene.world.step;
  ASSERT_EQ(frame.contacts.size(), 2u);
  for (const auto& force : frame.contacts.force) {
    EXPECT_NEAR(force.y() * step, momentum / 2, 1e-9);
    EXPECT_LE(force.norm() * step, momentum / (2 * scene.sine));
  }
}

// A sweep alone reduces the disc's velocity slowly. The flatter the lines of centres, the slower: over
// the wider gap, a tenth of the velocity is left after eight sweeps.
TEST(WedgedGrains, ALockedDiscStopsWithinTheSweepsOfAFlow)
{
  for (const double half : {1.43, 1.49}) {
    OverAGap scene(half);
    scene.world.solver = {.tolerance = 0.5, .max_sweeps = 8, .min_sweeps = 8};
    Simulation<2> simulation(scene.world, positions_of(scene.discs));
    simulation.set_velocity(2, {0, -1});
    simulation.advance();
    EXPECT_NEAR(simulation.velocity(2).norm(), 0, 1e-3) << half;
  }
}

TEST(WedgedGrains, BetweenBodiesThatPartADiscBearsNothing)
{
  OverAGap scene(1.43);
  Simulation<2> simulation(scene.world, positions_of(scene.discs));
  simulation.set_velocity(2, {0, -1});
  simulation.advance();
  simulation.set_velocity(0, {-1e-3, 0});
  Frame<2> frame;
  simulation.advance(frame);
  for (const auto& force : frame.contacts.force) EXPECT_LT(force.norm(), 1e-9);
}

TEST(WedgedGrains, ADiscThatFrictionCannotLockRebounds)
{
  // The tan of the angle is 0.97.
  const OverAGap scene(1.08);
  Simulation<2> simulation(scene.world, positions_of(scene.discs));
  simulation.set_velocity(2, {0, -1});
  simulation.advance();
  EXPECT_GT(simulation.velocity(2).y(), 0.1);
}

}  // namespace
}  // namespace grseg
