// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/recorder.hpp"
#include "sim/step/energies.hpp"
#include "tests/sim/small_chute.hpp"
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

/// Steps in which grains would approach each other by more than half a diameter are divided into parts.
namespace grseg {
namespace {

using worlds::Disc;
using worlds::positions_of;
using worlds::world_of;

/// Two equal discs of diameter 1 on a line; the first moves at `diameters` per step towards the
/// second and hits it head-on.
struct Collision {
  World<2> world;
  Simulation<2> simulation;

  Collision(double diameters, LawParameters law)
      : world(world_with(law)), simulation(world, {{-8.3, 0}, {0, 0}})
  {
    simulation.set_velocity(0, {diameters / world.step, 0});
  }
  static World<2> world_with(LawParameters law)
  {
    auto world = world_of({{{-8.3, 0}, 0.5}, {{0, 0}, 0.5}});
    world.material = {0, 0.25};
    world.law = law;
    return world;
  }
};

constexpr std::array laws{ContactLaw::speculative, ContactLaw::touch, ContactLaw::centred,
                          ContactLaw::predictive};

TEST(DividedStep, DiscsThatApproachByDiametersPerStepDoNotPassEachOther)
{
  for (const auto law : laws)
    for (const double diameters : {0.7, 1.9, 5.3, 20.0}) {
      Collision two(diameters, law_parameters(law, 0.75, 1e-3, 1, 1));
      int most_parts = 0;
      for (int step = 0; step < 40; ++step)
        most_parts = std::max(most_parts, two.simulation.advance().parts);
      EXPECT_GT(most_parts, 1) << diameters;
      const Vec2 a = two.simulation.velocity(0), b = two.simulation.velocity(1);
      const double speed = diameters / two.world.step;
      EXPECT_GT(two.simulation.position(1).x() - two.simulation.position(0).x(), 1) << diameters;
      // Newton's law and momentum conservation: u' = -e u, and the sum of velocities is constant.
      EXPECT_NEAR(b.x() - a.x(), 0.25 * speed, 1e-12 * speed) << diameters;
      EXPECT_NEAR(a.x() + b.x(), speed, 1e-12 * speed) << diameters;
    }
}

TEST(DividedStep, StepsAreWholeWhereNothingApproachesThatFast)
{
  Collision two(0.49, law_parameters(ContactLaw::touch, 0, 1e-3, 1, 1));
  for (int step = 0; step < 60; ++step) EXPECT_EQ(two.simulation.advance().parts, 1);
  EXPECT_LT(two.simulation.velocity(0).x(), two.simulation.velocity(1).x());
}

TEST(DividedStep, IsTheSameAsStepsOfThatLength)
{
  const auto law = law_parameters(ContactLaw::touch, 0, 1e-3, 1, 1);
  Collision whole(0.9, law), halves(0.9, law);
  auto world = halves.world;
  world.step /= 2;
  Simulation<2> by_halves(world, {{-8.3, 0}, {0, 0}});
  by_halves.set_velocity(0, halves.simulation.velocity(0));
  int divided = 0;
  for (int step = 0; step < 12; ++step) {
    divided += whole.simulation.advance().parts == 2;
    by_halves.advance();
    by_halves.advance();
    for (const std::size_t k : {0U, 1U})
      EXPECT_NEAR((whole.simulation.position(k) - by_halves.position(k)).norm(), 0, 1e-12);
  }
  EXPECT_GT(divided, 0);
}

/// Gives the n-th mobile grain a high velocity into the bed.
void shoot(Simulation<2>& bed, int n)
{
  const auto& fixed = bed.world().grains.fixed;
  for (std::size_t g = 0; g < fixed.size(); ++g)
    if (!fixed[g] && n-- == 0) bed.set_velocity(g, {60, -60});
}

Simulation<2> bed_with_a_bullet(const Scene& scene)
{
  auto bed = small_chute::bed(scene);
  for (int k = 0; k < 50; ++k) bed.advance();
  shoot(bed, 0);
  return bed;
}

TEST(DividedStep, ARestartBetweenDividedStepsChangesNoBit)
{
  for (const auto* precision : {"mixed", "double"}) {
    const auto scene = small_chute::scene({"--precision", precision});
    auto bed = bed_with_a_bullet(scene);
    int before = 0, after = 0;
    for (int k = 0; k < 2; ++k) before += bed.advance().parts > 1;
    Simulation<2> again(bed.world(), bed.state());
    for (auto* simulation : {&bed, &again}) shoot(*simulation, 10);
    for (int k = 0; k < 30; ++k) {
      after += bed.advance().parts > 1;
      again.advance();
    }
    EXPECT_GT(before, 0);
    EXPECT_GT(after, 0);
    for (std::size_t g = 0; g < bed.world().grains.size(); ++g) {
      EXPECT_EQ(bed.position(g), again.position(g));
      EXPECT_EQ(bed.velocity(g), again.velocity(g));
      EXPECT_EQ(bed.angular_velocity(g), again.angular_velocity(g));
    }
  }
}

/// Force m (v - v_before)/h on grains that the projectile hits, in units of the last digit of the
/// velocities, N.
double last_digits_of_a_force(const Simulation<2>& bed)
{
  const auto& mass = bed.world().grains.mass;
  const double speed = 60 * std::sqrt(2);
  return std::numeric_limits<double>::epsilon() * speed *
         *std::max_element(mass.begin(), mass.end()) / bed.written_step();
}

double largest_force(const Frame<2>& frame)
{
  double largest = 0;
  for (const auto& force : frame.contacts.force) largest = std::max(largest, force.norm());
  return largest;
}

TEST(DividedStep, AFrameIsItsLastPartAndForcesBalanceInIt)
{
  auto bed = bed_with_a_bullet(small_chute::scene());
  const auto& world = bed.world();
  Frame<2> frame;
  int divided = 0;
  for (int k = 0; k < 30; ++k) {
    const double begin = bed.time();
    const auto report = bed.advance(frame);
    EXPECT_LT(momentum_defect<2>(world.grains, frame, world.gravity),
              1e-12 + last_digits_of_a_force(bed) / largest_force(frame));
    EXPECT_NEAR(frame.time, begin + world.step - bed.written_step() / 2, 1e-12);
    EXPECT_EQ(bed.world().step, world.step);
    EXPECT_EQ(bed.written_step() < world.step, report.parts > 1);
    divided += report.parts > 1;
  }
  EXPECT_GT(divided, 0);
  EXPECT_LT(divided, 30);
}

TEST(DividedStep, ABedAtRestKnowsItsLoadInAPartOfAStep)
{
  // A column of five discs on a floor, whose loads few sweeps have found over many steps; and far
  // away, a disc that is shot at a fixed one.
  std::vector<Disc> discs{{{-20, 3}, 0.5, true}, {{-30, 3}, 0.5}};
  for (int k = 0; k < 5; ++k) discs.push_back({{0, 0.5 + k}, 0.5});
  auto world = world_of(discs);
  world.walls = {worlds::floor_at(0)};
  world.gravity = {0, -10};
  world.step = 1e-3;
  world.solver = {1e-12, 8};
  Simulation<2> simulation(world, positions_of(discs));
  const auto speed = [&] {
    double largest = 0;
    for (std::size_t k = 2; k < discs.size(); ++k)
      largest = std::max(largest, simulation.velocity(k).norm());
    return largest / 0.01;  // in units of g h
  };
  for (int step = 0; step < 500; ++step) {
    simulation.set_velocity(1, {0, 0});
    simulation.advance();
  }
  ASSERT_LT(speed(), 1e-9);
  int divided = 0;
  for (int step = 0; step < 20; ++step) {
    simulation.set_velocity(1, {0.9 / world.step, 0});
    divided += simulation.advance().parts > 1;
    EXPECT_LT(speed(), 1e-9);
  }
  EXPECT_GT(divided, 0);
}

TEST(DividedStep, TotalsCountTheStepsAndKeepTheFarthestApproach)
{
  StepReport whole, divided;
  whole.farthest_approach = 0.3;
  divided.farthest_approach = 0.1;
  divided.parts = 4;
  StepTotals totals, all;
  for (const auto& report : {whole, divided, divided}) totals.add(report);
  all.add(totals);
  all.add(totals);
  EXPECT_EQ(totals.divided, 2);
  EXPECT_EQ(all.divided, 4);
  EXPECT_EQ(all.farthest_approach, 0.3);
}

}  // namespace
}  // namespace grseg
