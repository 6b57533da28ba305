// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/energies.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/hard_cases/flows.hpp"
#include "tests/hard_cases/observed.hpp"
#include "tests/hard_cases/recorded.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// Coefficients and conditions at the limits of their ranges: each flow stays within its bound or
/// is stopped with a clear message.
namespace grseg::hard_cases {
namespace {

using worlds::Disc;
using worlds::positions_of;

constexpr double g = 9.8;

/// A heavy disc at rest on a light one on a floor.
Simulation<2> heavy_on_light(double ratio, double tolerance, int max_sweeps)
{
  const std::vector<Disc> discs{{{0, 0.5}, 0.5}, {{0, 1.5}, 0.5}};
  auto world = worlds::world_of(discs);
  world.grains.mass = {1, ratio};
  world.walls = {worlds::floor_at(0)};
  world.gravity = {0, -g};
  world.step = 0.01 / std::sqrt(g);  // 1/100 sqrt(d/g)
  world.solver = {tolerance, max_sweeps};
  return {world, positions_of(discs)};
}

TEST(MassRatio, OfAMillionOnOneIsCarriedIfThereAreEnoughSweeps)
{
  // A decade needs R ln 10 sweeps. Sweep k changes the velocity by L^(k - 1) g h, L = R/(1 + R)
  // (columns_test.cpp), and the first step ends when this is below the tolerance times g h. The next
  // step begins with twice the missing part, which is below the tolerance because loads are larger.
  const double ratio = 1e6, tolerance = 1e-6;
  auto pair = heavy_on_light(ratio, tolerance, 20000000);
  const auto first = pair.advance();
  Case("G1", "load of 10⁶ on 1 that the first step finds, over the weight")
      .near(first.base_impulse.y() / ((ratio + 1) * g * pair.world().step), 1, 1e-5);
  Case("G1", "sweeps of the first step")
      .near(first.solver.sweeps, ratio * std::log(1 / tolerance), 1e-4 * ratio);
  Case("G1", "sweeps of the second step").near(pair.advance().solver.sweeps, 1, 0);
}

TEST(MassRatio, OfAMillionOnOneStopsARunIfThereAreTooFewSweeps)
{
  // 500 sweeps per step act like a spring 500 m/h^2 with the mass m of the light disc: the heavy
  // disc sinks by 10^6 g h^2/500 = 0.2 d.
  const auto words = words_of_a_run(heavy_on_light(1e6, 1e-2, 500), 1, 2000);
  Case("G1", "with 500 sweeps the run says that the mean overlap is too large")
      .holds(words.find("the mean overlap is") != std::string::npos);
}

TEST(Column, OfFiveHundredDiscsSinksByNoMoreThanTwiceItsStaticSinking)
{
  // Sweeps act like springs N m/h^2 (columns_test.cpp). Under a sudden load they oscillate to twice their
  // deflection at rest: the top sinks by n^2 g h^2/N. The mean overlap at the bottom reaches 2 n g h^2/N;
  // with sweeps by colour, contacts of the first colour have twice that and the others none.
  const int n = 500, sweeps = 50, steps = 400;
  std::vector<Disc> discs;
  for (int k = 0; k < n; ++k) discs.push_back({{0, 0.5 + k}, 0.5});
  auto world = worlds::world_of(discs);
  world.walls = {worlds::floor_at(0)};
  world.gravity = {0, -g};
  world.step = 0.01 / std::sqrt(g);
  world.solver = {0, sweeps};
  Simulation<2> column(world, positions_of(discs));
  const double unit = g * world.step * world.step / sweeps;
  double overlap = 0, sinking = 0, sideways = 0;
  for (int step = 0; step < steps; ++step) {
    overlap = std::max(overlap, column.advance().largest_overlap);
    sinking = std::max(sinking, n - 0.5 - column.position(n - 1).y());
  }
  for (std::size_t k = 0; k < n; ++k)
    sideways = std::max(sideways, std::abs(column.position(k).x()));
  Case("G2", "overlap under 500 discs over 4ngh²/N").at_most(overlap / (4 * n * unit), 1);
  Case("G2", "sinking of the top over n²gh²/N").at_most(sinking / (n * n * unit), 1);
  Case("G2", "way sideways, m").near(sideways, 0, 0);
}

TEST(Coefficients, AtTheEndsOfTheirRangesKeepTheBalanceAndTheGrains)
{
  // A grain overlaps the floor by at most its way per step (H23), and it falls no faster than in a
  // free fall from the top. The bound ignores that weight also causes overlap: eight layers sink by
  // n^2 g h^2/N (G2), a thousandth of the bound.
  Case defects("G4", "energy defect of a step, friction 0, 1, 10 and e 0, 1"),
      overlap("G4", "overlap with the floor over the way per step after a fall from the top");
  for (const double mu : {0.0, 1.0, 10.0})
    for (const double e : {0.0, 1.0}) {
      auto c = flow(8, 8, 0.5);
      c.world.material = {mu, e};
      auto simulation = c.simulation();
      double top = 0;
      for (const auto& x : c.position) top = std::max(top, x.y());
      const double fall =
          c.world.step * std::sqrt(1 - 2 * c.world.gravity.y() * top);  // at most 1 m/s at first
      Frame<2> frame;
      for (int step = 0; step < 1500; ++step) {
        simulation.advance(frame);
        const auto balance = energy_balance<2>(c.world.grains, frame, simulation.before(),
                                               c.world.gravity, c.world.step);
        defects.at_most(balance.defect(), 1e-12);
        for (std::size_t k = 0; k < c.position.size(); ++k)
          overlap.at_most(
              std::max(0.0, c.world.grains.radius[k] - simulation.position(k).y()) / fall, 1);
      }
    }
}

/// Results for a dense cloud of rough discs between two walls, without gravity.
struct Cooling {
  double energy, largest_gain = 0,
                 gains = 0;  // ends over first energy; gain of a step; gains over first
  int sweeps = 0, missed = 0;

  explicit Cooling(double restitution)
  {
    auto c = crowd(8, 8, 1);
    c.world.walls = {worlds::floor_at(0), {{0, 10.4}, {0, -1}}};
    c.world.material = {0.5, restitution};
    c.world.solver = {1e-10, 500};
    auto cloud = c.simulation();
    const double all = kinetic_energy(cloud);
    double before = energy = all;
    for (int step = 0; step < 100000; ++step) {
      const auto report = cloud.advance().solver;
      sweeps = std::max(sweeps, report.sweeps);
      missed += report.converged ? 0 : 1;
      energy = kinetic_energy(cloud);
      largest_gain = std::max(largest_gain, energy / before - 1);
      gains += std::max(0.0, energy - before) / all;
      before = energy;
    }
    energy /= all;
  }
};

TEST(Cloud, OfRoughDiscsCoolsWithoutGravityUntilLoadsHaveFaded)
{
  // With e = 0 a step is a projection: sum p u after it is due to friction alone, so no step gains
  // energy. With e > 0, steps in which several contacts act may gain energy (impacts_test.cpp).
  const Cooling inelastic(0), rebounding(0.5);
  Case("G8", "largest gain of energy of a rough cloud in a step, e = 0, relative")
      .at_most(inelastic.largest_gain, 1e-9);
  Case("G8", "all gains of 1e5 steps at e = 0.5, over the energy at first")
      .at_most(rebounding.gains, 1e-3);
  for (const auto* c : {&inelastic, &rebounding}) {
    Case("G8", "energy left of a rough cloud after 1e5 steps, e = 0, 0.5")
        .between(c->energy, 1e-9, 0.02);
    Case("G8", "steps of a cooling cloud that miss a tolerance of 1e-10").at_most(c->missed, 0);
    Case("G8", "most sweeps of a step of a cooling cloud").at_most(c->sweeps, 499);
  }
}

/// A fixed floor of discs, five layers on it, and one disc that falls on them at 10^4 sqrt(g d).
Simulation<2> projectile(double step)
{
  std::vector<Disc> discs;
  for (int row = 0; row < 6; ++row)
    for (int k = 0; k < 20; ++k)
      discs.push_back({{1.02 * k + 0.3 * row, 1.02 * row}, 0.5, row == 0});
  discs.push_back({{10, 10}, 0.5});
  auto world = worlds::world_of(discs);
  world.box = {20.4, 100, true};
  world.gravity = {0, -g};
  world.material.restitution = 0.25;
  world.solver = {1e-2, 500};
  world.step = step;
  Simulation<2> simulation(world, positions_of(discs));
  simulation.set_velocity(discs.size() - 1, {0, -1e4 * std::sqrt(g)});
  return simulation;
}

/// Results for a projectile in a bed until it has slowed down.
struct Caught {
  double overlap = 0, gain = 0;  // overlap in d; relative energy gain of a step
  int divided = 0, below = 0;    // number of steps in parts; grains below the floor at the end

  Caught(double step, int steps)
  {
    auto bed = projectile(step);
    double energy = translational_energy(bed);
    for (int k = 0; k < steps; ++k) {
      const auto report = bed.advance();
      overlap = std::max(overlap, report.largest_overlap);
      divided += report.parts > 1;
      const double now = kinetic_energy(bed);
      gain = std::max(gain, now / energy - 1);
      energy = now;
    }
    for (std::size_t k = 20; k < bed.world().grains.size(); ++k)
      below += !(bed.position(k).y() > 0);
  }
};

TEST(Projectile, AtTenThousandTimesTheNaturalSpeedIsRefusedWithTheStepThatWouldDo)
{
  // The projectile moves by 100 d per step; a 64th of that is 1.6 d, and half a diameter is allowed.
  const double natural = 1 / std::sqrt(g), whole = 5e-5 * natural;
  const auto words = words_of_a_run(projectile(0.01 * natural), 1, 200);
  const auto at = words.find("use a step below ");
  ASSERT_NE(at, std::string::npos) << words;
  const double advised = std::stod(words.substr(at + 17));
  Case("G7", "step that the refusal asks for, 64 × 10⁻⁴ √(d/g)/2, s")
      .near(advised, 64 * whole, 64 * 3e-6);

  // With a tenth of the step, which needs no parts, the bed catches the projectile.
  const Caught gently(whole / 10, 20000);
  Case("G7", "overlap at a tenth of a step that needs no parts, of d").at_most(gently.overlap, 0.1);
  Case("G7", "largest gain of kinetic energy in a step, relative").at_most(gently.gain, 1e-3);
  EXPECT_EQ(gently.divided, 0);
  EXPECT_EQ(gently.below, 0);

  // Steps in parts catch it, too, with an overlap of at most the way in one part.
  const Caught in_parts(advised / 10, 320);
  Case("G7", "overlap in steps of some 3 d, taken in parts, of d").at_most(in_parts.overlap, 0.5);
  Case("G7", "grains that such a projectile pushes through the floor").at_most(in_parts.below, 0);
  EXPECT_GT(in_parts.divided, 0);
}

}  // namespace
}  // namespace grseg::hard_cases
