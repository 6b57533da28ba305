// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/simulation.hpp"

#include "formats/core/errors.hpp"
#include "sim/run/recorder.hpp"
#include "sim/step/energies.hpp"
#include "tests/sim/small_chute.hpp"
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace grseg {
namespace {

using worlds::Disc;
using worlds::floor_at;
using worlds::positions_of;
using worlds::world_of;

constexpr double g = 9.8;

void run(Simulation<2>& simulation, double duration)
{
  const auto steps = std::llround(duration / simulation.world().step);
  for (std::int64_t k = 0; k < steps; ++k) simulation.advance();
}

/// A few dozen discs of several sizes, poured onto a floor between walls, at rest.
Simulation<2> settled_heap(double tolerance)
{
  std::vector<Disc> discs;
  for (int row = 0; row < 8; ++row)
    for (int k = 0; k < 6; ++k)
      discs.push_back({{0.75 + 1.2 * k + 0.05 * (row % 3), 0.7 + 1.2 * row},
                       0.4 + 0.02 * ((5 * row + 3 * k) % 10)});
  auto world = world_of(discs);
  world.walls = {floor_at(0), {{0, 0}, {1, 0}}, {{7.5, 0}, {-1, 0}}};
  world.gravity = {0, -g};
  world.solver = {tolerance, 20000};
  Simulation<2> simulation(world, positions_of(discs));
  run(simulation, 30);  // nothing slows a disc that rolls on the floor until it meets another
  return simulation;
}

TEST(Simulation, ASettledBedPressesOnItsBaseWithItsWeightAtEveryStep)
{
  auto simulation = settled_heap(1e-9);
  double weight = 0;
  for (const double m : simulation.world().grains.mass) weight += m * g;
  Frame<2> frame;
  for (int k = 0; k < 20; ++k) {
    simulation.advance(frame);
    double base = 0;
    for (std::size_t c = 0; c < frame.contacts.size(); ++c)
      if (frame.contacts.j[c] < 0) base += frame.contacts.force[c].y();
    EXPECT_NEAR(base, weight, 1e-6 * weight);
  }
  EXPECT_LT(translational_energy(simulation), 1e-8 * weight);
}

TEST(Simulation, ContactForcesAndWeightMakeUpTheForceOfEveryGrainToRoundOff)
{
  auto simulation = settled_heap(1e-2);
  simulation.tilt(Vec2(g * std::sin(0.5), -g * std::cos(0.5)));
  Frame<2> frame;
  for (int k = 0; k < 100; ++k) {
    simulation.advance(frame);
    EXPECT_LT(momentum_defect<2>(simulation.world().grains, frame, simulation.world().gravity),
              1e-12);
  }
}

TEST(Simulation, AFrameIsTheMiddleOfItsStep)
{
  const std::vector<Disc> discs{{{9.9995, 5}, 0.5}, {{2, 2}, 0.5}};
  auto world = world_of(discs);
  world.box = {10, 10, true};
  Simulation<2> simulation(world, positions_of(discs));
  simulation.set_velocity(0, {1, 0});
  Frame<2> frame;
  simulation.advance(frame);
  EXPECT_EQ(frame.step, 0);
  EXPECT_DOUBLE_EQ(frame.time, 0.5e-3);
  EXPECT_NEAR(frame.position[0].x(), 0, 1e-12);
  EXPECT_EQ(frame.image[0][0], 1);
  EXPECT_EQ(frame.velocity[0], Vec2(1, 0));
  EXPECT_NEAR(simulation.position(0).x(), 10.0005, 1e-12);
}

TEST(Simulation, WritingFramesChangesNothing)
{
  auto watched = settled_heap(1e-2), alone = watched;
  Frame<2> frame;
  for (int k = 0; k < 50; ++k) {
    watched.advance(frame);
    alone.advance();
  }
  for (std::size_t d = 0; d < watched.world().grains.size(); ++d) {
    EXPECT_EQ(watched.position(d), alone.position(d));
    EXPECT_EQ(watched.velocity(d), alone.velocity(d));
    EXPECT_EQ(watched.angular_velocity(d), alone.angular_velocity(d));
  }
}

TEST(Simulation, AShiftAlongThePeriodChangesNoForce)
{
  // A row of discs on a floor, one of them leaning on two others: some contacts are across the period.
  const auto forces = [](double shift) {
    std::vector<Disc> discs{
        {{0.5, 0.5}, 0.5}, {{1.5, 0.5}, 0.5}, {{1.0, 1.3}, 0.5}, {{3.5, 0.5}, 0.5}};
    for (auto& d : discs) d.position.x() += shift - 4 * std::floor((d.position.x() + shift) / 4);
    auto world = world_of(discs);
    world.box = {4, 10, true};
    world.walls = {floor_at(0)};
    world.gravity = {1, -g};
    Simulation<2> simulation(world, positions_of(discs));
    Frame<2> frame;
    for (int k = 0; k < 100; ++k) simulation.advance(frame);
    std::vector<Vec2> on(discs.size(), Vec2::Zero());
    for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
      on[static_cast<std::size_t>(frame.contacts.i[c])] += frame.contacts.force[c];
      if (frame.contacts.j[c] >= 0)
        on[static_cast<std::size_t>(frame.contacts.j[c])] -= frame.contacts.force[c];
    }
    return on;
  };
  const auto here = forces(0);
  for (const double shift : {0.3, 2.0, 3.2}) {
    const auto there = forces(shift);
    for (std::size_t d = 0; d < here.size(); ++d) EXPECT_NEAR((here[d] - there[d]).norm(), 0, 1e-9);
  }
}

TEST(Simulation, ABeadOnTheBaseStaysOnTheBase)
{
  // Boundary grains do not move, even if grains fall on them.
  const std::vector<Disc> discs{{{0, 3}, 0.5}, {{-0.5, 0}, 0.5, true}, {{0.5, 0}, 0.5, true}};
  auto world = world_of(discs);
  world.material.restitution = 0.25;
  world.gravity = {0, -g};
  Simulation<2> simulation(world, positions_of(discs));
  run(simulation, 2);
  EXPECT_EQ(simulation.position(1), Vec2(-0.5, 0));
  EXPECT_EQ(simulation.velocity(2), Vec2(0, 0));
  EXPECT_NEAR(simulation.position(0).y(), std::sqrt(0.75), 1e-2);
}

TEST(Simulation, ARestingDiscWithRestitutionCarriesItsWeightAndDoesNotRattle)
{
  const std::vector<Disc> discs{{{0, 0.5}, 0.5}};
  auto world = world_of(discs);
  world.material.restitution = 0.25;
  world.walls = {floor_at(0)};
  world.gravity = {0, -g};
  Simulation<2> simulation(world, positions_of(discs));
  Frame<2> frame;
  for (int k = 0; k < 10; ++k) {
    simulation.advance(frame);
    ASSERT_EQ(frame.contacts.size(), 1u);
    EXPECT_NEAR(frame.contacts.force[0].y(), world.grains.mass[0] * g, 1e-12);
  }
}

TEST(Simulation, EnergiesAreThoseOfADiscThatFliesAndSpins)
{
  const std::vector<Disc> discs{{{1, 3}, 0.25}, {{9, 9}, 0.5, true}};
  auto world = world_of(discs);
  world.gravity = {0, -g};
  Simulation<2> simulation(world, positions_of(discs));
  simulation.set_velocity(0, {3, 4}, 8);
  const double m = world.grains.mass[0];
  EXPECT_EQ(simulation.angular_velocity(0), 8);
  EXPECT_NEAR(translational_energy(simulation), m * 25 / 2, 1e-14);
  EXPECT_NEAR(rotational_energy(simulation), m * 0.25 * 0.25 / 2 * 8 * 8 / 2, 1e-14);
  EXPECT_NEAR(potential_energy(simulation), m * g * 3, 1e-13);
}

TEST(Simulation, BranchIsTheDistanceOfTheCentresAndGapNegativeWhereDiscsOverlap)
{
  const std::vector<Disc> discs{{{0, 5}, 0.5}, {{0.59, 5.0}, 0.1}, {{0, 0.49}, 0.5}};
  auto world = world_of(discs);
  world.walls = {floor_at(0)};
  Simulation<2> simulation(world, positions_of(discs));
  Frame<2> frame;
  simulation.advance(frame);
  ASSERT_EQ(frame.contacts.size(), 2u);
  EXPECT_NEAR((frame.contacts.branch[0] - Vec2(-0.59, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR(frame.contacts.gap[0], -0.01, 1e-15);
  EXPECT_NEAR((frame.contacts.branch[1] - Vec2(0, 0.49)).norm(), 0, 1e-15);
  EXPECT_NEAR(frame.contacts.gap[1], -0.01, 1e-15);
}

TEST(Simulation, AFrameUnwrapsToTheTruePositionWheneverTheListWasMade)
{
  // The list is made while x > 0; then the disc crosses x = 0 by less than the skin, also by 1e-18.
  for (const double x : {-1e-3, -1e-18}) {
    const std::vector<Disc> discs{{{1e-3, 5}, 0.5}};
    auto world = world_of(discs);
    world.box = {10, 10, true};
    Simulation<2> simulation(world, positions_of(discs));
    Frame<2> frame;
    simulation.advance(frame);
    simulation.set_velocity(0, {(x - 1e-3) / (world.step / 2), 0});
    simulation.advance(frame);
    EXPECT_GE(frame.position[0].x(), 0);
    EXPECT_LT(frame.position[0].x(), 10);
    EXPECT_NEAR(frame.position[0].x() + 10 * frame.image[0][0], x, 1e-12);
  }
}

TEST(Simulation, ADiscThatCrossesTheCellMoreOftenThanAFileCountsEndsTheRun)
{
  const std::vector<Disc> discs{{{1, 5}, 0.5}};
  auto world = world_of(discs);
  world.box = {10, 10, true};
  auto state = Simulation<2>(world, positions_of(discs)).state();
  state.image[0] = {most_periods};
  state.position[0] = {10.5, 5};
  EXPECT_THROW(Simulation<2>(world, state).advance(), RunError);
  --state.image[0][0];
  EXPECT_NO_THROW(Simulation<2>(world, state).advance());
}

TEST(Simulation, ASlowRiseUnderGravityFallsBackByLessThanItRoseAndEndsAtRest)
{
  const std::vector<Disc> discs{{{0, 0.499}, 0.5}};
  auto world = world_of(discs);
  world.material.restitution = 0.25;
  world.walls = {floor_at(0)};
  world.gravity = {0, -g};
  Simulation<2> simulation(world, positions_of(discs));
  simulation.set_velocity(0, {0, 0.005});  // less than g h = 0.0098
  for (int step = 0; step < 20; ++step) {
    simulation.advance();
    EXPECT_GE(simulation.position(0).y(), 0.499);
  }
  EXPECT_NEAR(simulation.velocity(0).y(), 0, 1e-14);
}

/// Mean number of sweeps per step over the next `duration`, s.
double sweeps(Simulation<2>& flow, double duration)
{
  const auto steps = std::llround(duration / flow.world().step);
  double sum = 0;
  for (std::int64_t k = 0; k < steps; ++k) sum += static_cast<double>(flow.advance().solver.sweeps);
  return sum / static_cast<double>(steps);
}

// An impact lowers the first guesses. If guesses could not recover afterwards, every step would be
// treated as an impact: the flow would never have guesses again, and need twice the sweeps. With
// guesses it needs 24 (docs/studies/performance.md).
TEST(Simulation, AnImpactOnAFlowIsOverAfterIt)
{
  auto flow = small_chute::bed(
      small_chute::paper_scene({"--depth", "60dS", "--length", "8dL", "--slope", "26",
                                "--phi-large", "0.45", "--tolerance", "0.05"}));
  run(flow, 3);  // the start of the flow is an impact, too
  EXPECT_LT(sweeps(flow, 0.5), 30);
  for (std::size_t g = 0; g < flow.world().grains.size(); ++g)
    if (!flow.world().grains.fixed[g]) flow.set_velocity(g, flow.velocity(g) - Vec2(0, 0.5));
  run(flow, 0.5);
  EXPECT_LT(sweeps(flow, 0.5), 30);
}

}  // namespace
}  // namespace grseg
