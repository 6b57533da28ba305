// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/hard_cases/flows.hpp"
#include "tests/hard_cases/observed.hpp"
#include "tests/hard_cases/recorded.hpp"

#include <gtest/gtest.h>

#include <cmath>

/// Discs that overlap, barely touch, have the same centre or barely fit into their cell.
namespace grseg::hard_cases {
namespace {

using worlds::Disc;
using worlds::positions_of;

TEST(Overlap, OfTwoDiscsAtRestStaysAndGivesNoEnergy)
{
  // No force pushes overlapping discs apart, so overlap does not change velocities.
  Case overlap("H20", "overlap after 1000 steps, m"), energy("H20", "kinetic energy, J");
  for (const double delta : {1e-6, 0.01, 0.2, 0.9})
    for (const double e : {0.0, 1.0}) {
      const std::vector<Disc> discs{{{0, 0}, 0.5}, {{1 - delta, 0}, 0.5}};
      auto world = worlds::world_of(discs);
      world.material.restitution = e;
      Simulation<2> pair(world, positions_of(discs));
      for (int step = 0; step < 1000; ++step) pair.advance();
      overlap.near(1 - (pair.position(1) - pair.position(0)).norm(), delta, 1e-15);
      energy.near(kinetic_energy(pair), 0, 0);
    }
}

TEST(Overlap, OfAFifthInACrowdAtRestGivesNoEnergyAndUnderGravityStopsARunWithAdvice)
{
  // The radii of the crowd are a fifth larger than the lattice has space for.
  auto c = crowd(8, 8, 0);
  for (auto& r : c.world.grains.radius) r = 0.75;  // lattice 1.2
  auto floating = c.simulation();
  for (int step = 0; step < 200; ++step) floating.advance();
  Case("G5", "energy of a crowd with 20 % overlaps at rest, J")
      .near(kinetic_energy(floating), 0, 0);

  c.world.gravity = {0, -9.8};
  c.world.walls = {worlds::floor_at(0)};
  const auto words = words_of_a_run(c.simulation(), 0.5, 50);
  Case("G5", "a run under gravity says that the mean overlap is too large and what to do")
      .holds(words.find("the mean overlap is") != std::string::npos &&
             words.find("use a smaller step") != std::string::npos);
}

/// Velocity after a disc moves down on another one; `gap` is the gap in the middle of the next step.
Vec2 velocity_after(double gap)
{
  const std::vector<Disc> discs{{{0, 0}, 0.5}, {{0, 0}, 0.5, true}};
  auto world = worlds::world_of(discs);
  world.material = {0.3, 0.5};
  const Vec2 n{0.6, 0.8}, velocity{0.3, -2};
  Simulation<2> pair(world, {(1 + gap) * n - world.step / 2 * velocity, {0, 0}});
  pair.set_velocity(0, velocity, 3);
  pair.advance();
  return pair.velocity(0);
}

TEST(Gap, OfABillionthOfADiameterMoreOrLessMakesNoDifference)
{
  Case impact("H21", "change of the velocity after an impact, m/s"),
      load("H21", "force on a disc at rest over its weight");
  for (const double gap : {1e-12, -1e-12, 1e-15}) {
    impact.at_most((velocity_after(gap) - velocity_after(0)).norm(), 1e-11);
    const std::vector<Disc> discs{{{0, 0.5 + gap}, 0.5}};
    auto world = worlds::world_of(discs);
    world.walls = {worlds::floor_at(0)};
    world.gravity = {0, -9.8};
    Simulation<2> disc(world, positions_of(discs));
    Frame<2> frame;
    for (int step = 0; step < 100; ++step) {
      disc.advance(frame);
      ASSERT_EQ(frame.contacts.size(), 1u);
      load.near(frame.contacts.force[0].y() / (9.8 * world.grains.mass[0]), 1, 1e-12);
    }
  }
}

TEST(CoincidentCentres, StopARunWithTheIdsOfBoth)
{
  auto c = crowd(4, 4, 0);
  c.position[9] = c.position[6];
  auto simulation = c.simulation();
  std::string words;
  try {
    simulation.advance();
  } catch (const RunError& error) {
    words = error.what();
  }
  Case("H22", "a sentence names both grains and the remedy")
      .holds(words.find("grains 6 and 9 coincide") != std::string::npos &&
             words.find("start from separate positions") != std::string::npos);
}

}  // namespace
}  // namespace grseg::hard_cases
