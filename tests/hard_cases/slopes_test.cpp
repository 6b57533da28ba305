// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/geometry.hpp"
#include "sim/step/energies.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/hard_cases/flows.hpp"
#include "tests/hard_cases/observed.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

/// Gravity that changes its direction during a simulation.
namespace grseg::hard_cases {
namespace {

using std::numbers::pi;
using worlds::Disc;
using worlds::positions_of;

constexpr double g = 9.8;

/// A disc of radius 1/2 on a floor that is level at first; its slope increases by `angle` in every step.
Simulation<2> disc_on_turning_floor(double angle, double friction)
{
  const std::vector<Disc> discs{{{0, 0.5}, 0.5}};
  auto world = worlds::world_of(discs);
  world.walls = {worlds::floor_at(0)};
  world.gravity = {0, -g};
  world.material = {friction, 0};
  Simulation<2> simulation(world, positions_of(discs));
  simulation.tilt(Gravity<2>(world.gravity, angle / world.step));
  return simulation;
}

TEST(Slope, ThatBecomesSteeperDrivesARollingDiscByTwoThirdsOfTheSumOfItsSines)
{
  // a = (2/3) g sin of the slope in the middle of each step; the sum of sin((k + 1/2) angle) over n
  // steps is sin^2(n angle/2)/sin(angle/2). Valid up to 40 degrees, whose tan is below 3 mu.
  const int steps = 2000;
  const double angle = 40 * pi / 180 / steps;
  auto disc = disc_on_turning_floor(angle, 0.5);
  for (int k = 0; k < steps; ++k) disc.advance();
  const double sum = std::pow(std::sin(steps * angle / 2), 2) / std::sin(angle / 2);
  Case("G12", "speed of a disc that rolls down a slope from 0 to 40°, over its closed form")
      .near(disc.velocity(0).x() / (2.0 / 3 * g * disc.world().step * sum), 1, 1e-10);
  Case("G12", "rω over its speed")
      .near(-disc.angular_velocity(0) / 2 / disc.velocity(0).x(), 1, 1e-10);
}

TEST(Gravity, TurnedUpsideDownReleasesASmoothDiscAtNinetyDegrees)
{
  // Until the slope is vertical the floor carries the disc; from there to 180 degrees the disc
  // gains the sum of g h sin of as many steps, and along the floor twice that.
  const int quarter = 1000;
  const double angle = pi / 2 / quarter;
  auto disc = disc_on_turning_floor(angle, 0);
  const double gained = g * disc.world().step / (2 * std::sin(angle / 2));
  Case pressed("G11", "height of the disc on its floor until the slope is vertical, m");
  for (int k = 0; k < quarter; ++k) {
    disc.advance();
    pressed.near(disc.position(0).y(), 0.5, 1e-13);
  }
  for (int k = 0; k < quarter; ++k) disc.advance();
  Case("G11", "velocity away from the floor at 180°, over its closed form")
      .near(disc.velocity(0).y() / gained, 1, 1e-10);
  Case("G11", "velocity along the floor, over its closed form")
      .near(disc.velocity(0).x() / (2 * gained), 1, 1e-10);
}

/// All variables on which steps depend, as bits.
std::vector<std::uint64_t> bits_of(const Simulation<2>& simulation)
{
  std::vector<std::uint64_t> bits;
  const auto state = simulation.state();
  for (const auto* vectors : {&state.position, &state.velocity})
    for (const auto& v : *vectors)
      for (const double x : {v.x(), v.y()}) bits.push_back(std::bit_cast<std::uint64_t>(x));
  for (const auto& s : state.rim) bits.push_back(std::bit_cast<std::uint64_t>(s[0]));
  return bits;
}

TEST(Slope, ThatTurnsContinuesBitForBitAfterARestart)
{
  const auto scene = small_chute::scene({"--slope-rate", "40"});
  auto whole = deposit<2>(scene);
  const auto world = whole.world();
  whole.tilt(gravity_of<2>(scene));
  for (int k = 0; k < 300; ++k) whole.advance();
  Simulation<2> again(world, whole.state());
  again.tilt(gravity_of<2>(scene));
  for (int k = 0; k < 300; ++k) {
    whole.advance();
    again.advance();
  }
  Case("G12", "600 steps on a slope that turns are 300, a restart and 300, bit for bit")
      .holds(bits_of(whole) == bits_of(again));
  Case("G12", "slope after 600 steps at 40°/s, °")
      .near(std::atan2(whole.world().gravity.x(), -whole.world().gravity.y()) * 180 / pi,
            scene.slope + 40 * (599.5 * scene.step), 1e-9);
}

TEST(Gravity, ReversedLetsABedFallUpwardsAsAWhole)
{
  // Contacts do not pull and overlaps do not push, so every grain gains g t.
  auto c = flow(8, 6, 0);
  auto bed = c.simulation();
  for (int step = 0; step < 6000; ++step) bed.advance();
  std::vector<Vec2> before;
  for (std::size_t k = 0; k < c.position.size(); ++k) before.push_back(bed.velocity(k));
  const double noise = std::sqrt(2 * kinetic_energy(bed) / c.world.grains.mass[0]);
  bed.tilt(Vec2(0, g));
  for (int step = 0; step < 500; ++step) bed.advance();
  const double gained = g * 500 * c.world.step;
  Case speeds("G11", "velocity after 0.5 s of reversed gravity, over gt"),
      calm("G11", "speed of the bed before, over gt");
  calm.at_most(noise / gained, 1e-2);
  for (const auto& v : before) EXPECT_TRUE(v.allFinite());
  for (std::size_t k = 0; k < c.position.size(); ++k)
    speeds.near(bed.velocity(k).y() / gained, 1, 1e-2);
}

TEST(Slope, ThatChangesDuringTheRunKeepsTheEnergyBudgetOfEveryStep)
{
  // The slope goes from level to 45 degrees and back, by a small angle per step. No grain overlaps
  // the floor by more than its way per step (H23) after a free fall from the top.
  Case defects("G12", "energy defect of a step while the slope turns"),
      overlaps("G12", "mean overlap, of d_S"),
      floor("G12", "overlap with the floor over the way per step after a fall from the top");
  auto c = flow(8, 8, 0);
  auto simulation = c.simulation();
  Frame<2> frame;
  const int steps = 6000;
  double overlap = 0, touching = 0;
  for (int step = 0; step < steps; ++step) {
    const double slope = 0.25 * std::numbers::pi * std::sin(std::numbers::pi * step / steps);
    simulation.tilt(Vec2(g * std::sin(slope), -g * std::cos(slope)));
    const auto report = simulation.advance(frame);
    overlap += report.sum_overlap;
    touching += static_cast<double>(report.touching);
    const auto& world = simulation.world();
    defects.at_most(
        energy_balance<2>(world.grains, frame, simulation.before(), world.gravity, world.step)
            .defect(),
        1e-12);
  }
  overlaps.at_most(overlap / touching / 0.7, 0.01);
  double top = 0;
  for (const auto& x : c.position) top = std::max(top, x.y());
  const double fall = c.world.step * std::sqrt(1 + 2 * g * top);  // at most 1 m/s at first
  for (std::size_t k = 0; k < c.position.size(); ++k)
    floor.at_most(std::max(0.0, c.world.grains.radius[k] - simulation.position(k).y()) / fall, 1);
}

}  // namespace
}  // namespace grseg::hard_cases
