// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "sim/run/recorder.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/hard_cases/laws.hpp"
#include "tests/hard_cases/observed.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

/// A single disc that falls, bounces, stops, or is too fast for the step.
namespace grseg::hard_cases {
namespace {

using worlds::Disc;
using worlds::floor_at;
using worlds::positions_of;

using Fall = UnderEveryLaw;
INSTANTIATE_TEST_SUITE_P(Laws, Fall, testing::ValuesIn(laws()), name_of);

constexpr double g = 9.8, r = 0.5;

/// A disc whose lowest point is `height` above a floor.
Simulation<2> released(World<2> world, double height, double restitution, double step)
{
  world.walls = {floor_at(0)};
  world.material.restitution = restitution;
  world.gravity = {0, -g};
  world.step = step;
  return {world, {{0, r + height}}};
}

/// Height of the next apex of the disc, relative to its height at rest.
double apex(const Simulation<2>& s)
{
  const double v = s.velocity(0).y();
  return s.position(0).y() - r + v * v / (2 * g);
}

TEST_P(Fall, FreeFallIsExactForAnyStep)
{
  Case way("H1", "height after 2 s, m"), speed("H1", "velocity after 2 s, m/s");
  for (const double step : {0.25, 0.01, 1e-4}) {
    auto world = world_of({{{0, 0}, r}});
    world.gravity = {0, -g};
    world.step = step;
    Simulation<2> simulation(world, {{0, 100}});
    for (auto k = std::llround(2 / step); k > 0; --k) simulation.advance();
    way.near(simulation.position(0).y(), 100 - g * 2 * 2 / 2, 1e-10);
    speed.near(simulation.velocity(0).y(), -2 * g, 1e-11);
  }
}

/// Follows a bouncing disc until 2 t*; its infinitely many bounces (Zeno) end at t*.
struct Bounces {
  std::vector<double> apexes;
  double path = 0;      // length of the path, m
  double last_run = 0;  // last time at which it was faster than g h, s

  explicit Bounces(Simulation<2>& simulation, double until)
  {
    const double h = simulation.world().step;
    while (simulation.time() < until) {
      const double y = simulation.position(0).y(), v = simulation.velocity(0).y();
      simulation.advance();
      const double w = simulation.velocity(0).y();
      if (v < 0 && w > 0) apexes.push_back(apex(simulation));
      if (std::abs(w) > 1.01 * g * h) last_run = simulation.time();
      path += std::abs(simulation.position(0).y() - y);
    }
  }
};

TEST_P(Fall, ZenosBouncesEndInFiniteTimeWithAnErrorOfFirstOrder)
{
  // An impact at speed v changes e^2 times the apex by at most (1 - e)(1 + 3e/2) v h, because the step in
  // which it happens begins up to a step's way above the ground. With v = e^(n-1) v_0 these changes add up
  // to (1 + 3e/2) v_0 h e^(n-1), and over the way up and down to 2 (1 + 3e/2) v_0 h/(1 - e).
  const double height = 1, v0 = std::sqrt(2 * g * height);
  Case heights("H4", "apexes e²ⁿ H, m"), path("H4", "path H (1 + e²)/(1 − e²), m"),
      ends("H4", "end of the bounces t*, s"), still("H4", "speed after that, m/s");
  for (const double e : {0.25, 0.5, 0.8})
    for (const double h : {1e-3, 1e-4}) {
      auto simulation = released(world_of({{{0, 0}, r}}), height, e, h);
      const double end = std::sqrt(2 * height / g) * (1 + e) / (1 - e);
      const Bounces seen(simulation, 2 * end);
      const double unit = 1.1 * (1 + 1.5 * e) * v0 * h;  // impacts are faster by up to g h
      int n = 0;
      while (v0 * std::pow(e, n) > 10 * g * h) {
        ++n;
        heights.near(seen.apexes.at(static_cast<std::size_t>(n - 1)), height * std::pow(e, 2 * n),
                     unit * std::pow(e, n - 1));
      }
      path.near(seen.path, height * (1 + e * e) / (1 - e * e), 2 * unit / (1 - e));
      const double bounces = std::log(v0 / (g * h)) / std::log(1 / e);
      ends.near(seen.last_run, end, 2 * h * bounces * (1 + e) / (1 - e));
      still.near(simulation.velocity(0).y(), 0, 1e-15);
      EXPECT_NEAR(simulation.position(0).y(), r, 2 * g * h * h);
    }
}

TEST_P(Fall, AnElasticDiscBouncesToTheSameHeightTenThousandTimes)
{
  // An elastic impact reverses the velocity at the position where its step began, so the discrete
  // motion is reversed exactly.
  auto simulation = released(world_of({{{0, 0}, r}}), 1, 1, 0.02);
  double highest = 0, lowest = 2;
  for (int bounces = 0; bounces < 10000;) {
    const double before = simulation.velocity(0).y();
    simulation.advance();
    bounces += before < 0 && simulation.velocity(0).y() > 0;
    highest = std::max(highest, apex(simulation));
    lowest = std::min(lowest, apex(simulation));
  }
  Case apexes("H5", "apexes of 10,000 elastic bounces, m");
  apexes.near(highest, 1, 1e-11);
  apexes.near(lowest, 1, 1e-11);
}

TEST_P(Fall, AnElasticDiscInASmoothBoxKeepsItsEnergy)
{
  auto world = world_of({{{0, 0}, r}});
  world.walls = {floor_at(0), {{0, 7}, {0, -1}}, {{0, 0}, {1, 0}}, {{9, 0}, {-1, 0}}};
  world.material = {0, 1};
  world.step = 0.1;
  Simulation<2> simulation(world, {{3, 4}});
  simulation.set_velocity(0, {1.3, 0.7}, 2);
  const double start = kinetic_energy(simulation);
  int impacts = 0;
  while (impacts < 10000) {
    const auto before = simulation.velocity(0);
    simulation.advance();
    impacts += before != simulation.velocity(0);
    ASSERT_TRUE(std::abs(simulation.position(0).x() - 4.5) < 4.5);
  }
  Case("H5", "energy after 10,000 elastic impacts in a box, over that before")
      .near(kinetic_energy(simulation) / start, 1, 1e-13);
}

TEST_P(Fall, AnInelasticDiscStopsAtItsFirstContactAndStays)
{
  const double h = 1e-3;
  Case stops("H6", "velocity after the first contact, m/s"),
      stays("H6", "way in the 1000 steps after it, m");
  for (int phase = 0; phase < 50; ++phase) {
    auto simulation = released(world_of({{{0, 0}, r}}), 0.1 + 1e-4 * phase, 0, h);
    double speed = 0;
    while (simulation.advance().touching == 0) speed = -simulation.velocity(0).y();
    stops.near(simulation.velocity(0).y(), 0, 1e-15);
    const double stopped_at = simulation.position(0).y();
    EXPECT_NEAR(stopped_at, r, speed * h);
    for (int k = 0; k < 1000; ++k) simulation.advance();
    stops.near(simulation.velocity(0).y(), 0, 1e-15);
    stays.near(simulation.position(0).y(), stopped_at, 1e-13);
  }
}

/// A row of touching fixed discs along y = 0, and one disc above it that moves down by `per_step`
/// diameters per step, over a disc (offset 0) or between two (offset 1/2).
Simulation<2> over_a_row(World<2> world, double offset, double height, double per_step)
{
  std::vector<Disc> discs{{{offset, height}, r}};
  for (int k = -3; k <= 3; ++k) discs.push_back({{static_cast<double>(k), 0}, r, true});
  world.grains = worlds::world_of(discs).grains;
  Simulation<2> simulation(world, positions_of(discs));
  simulation.set_velocity(0, {0, -per_step / world.step});
  return simulation;
}

TEST_P(Fall, ADiscAsFastAsARunAllowsDoesNotPassThroughTheBase)
{
  // Half a diameter per step is the largest motion that the recorder accepts.
  Case overlaps("H23", "overlap with the base, of the way per step");
  for (const double offset : {0.0, 0.25, 0.5})
    for (const double per_step : {0.01, 0.1, 0.3, 0.5})
      for (int phase = 0; phase < 100; ++phase) {
        auto simulation = over_a_row(world_of({}), offset, 2 + per_step * phase / 100, per_step);
        double overlap = 0;
        for (int k = 0; k < 4 / per_step; ++k)
          overlap = std::max(overlap, simulation.advance().largest_overlap);
        overlaps.at_most(overlap / per_step, 1 + 1e-11);
        EXPECT_GT(simulation.position(0).y(), std::sqrt(0.75) - per_step);
      }
}

class Tunnelling : public UnderEveryLaw {
 protected:
  std::string path = (std::filesystem::temp_directory_path() /
                      ("grseg_falls_test_" + std::to_string(getpid()) + ".h5"))
                         .string();
  void TearDown() override { std::filesystem::remove(path); }

  struct Run {
    std::string words;  // message with which it is stopped within ten steps, or none
    double lowest = std::numeric_limits<double>::infinity();  // lowest height, m
    int divided = 0;                                          // steps taken in parts
  };
  Run run(Simulation<2> simulation)
  {
    Run seen;
    const auto& world = simulation.world();
    TrajectoryWriter writer(path, {world.grains, world.box, {}, Recorder::observables(2)});
    Recorder recorder(writer, 2 * r);
    Frame<2> frame;
    try {
      for (int k = 0; k < 10; ++k) {
        const auto report = simulation.advance(frame);
        seen.divided += report.parts > 1;
        seen.lowest = std::min(seen.lowest, simulation.position(0).y());
        recorder.add(report);
        recorder.write(frame, simulation);
      }
    } catch (const RunError& error) {
      seen.words = error.what();
    }
    return seen;
  }
};

INSTANTIATE_TEST_SUITE_P(Laws, Tunnelling, testing::ValuesIn(laws()), name_of);

TEST_P(Tunnelling, ADiscThatCouldPassAnotherWithinAPartOfAStepStopsTheRunWithTheStepThatWouldDo)
{
  // 40 diameters per step are 5/8 of a diameter in each of the 64 parts; half a diameter is allowed.
  const auto words = run(over_a_row(world_of({}), 0, 42, 40)).words;
  EXPECT_NE(words.find("0.62 d_S in 1/64 of a step"), std::string::npos) << words;
  EXPECT_NE(words.find("use a step below 0.0008 s"), std::string::npos) << words;
}

TEST_P(Tunnelling, ADiscThatCouldPassThroughARowWithinAStepDoesNotAtAnyPhase)
{
  // Steps are taken in parts. The run continues, or is stopped because of the overlap in an impact.
  Case passed("H23", "discs at 1 to 31 diameters per step that passed a row"),
      divided("H23", "runs of them without a step in parts");
  int through = 0, whole = 0;
  for (const double per_step : {1.0, 1.4, 2.0, 5.0, 31.0})
    for (const double offset : {0.0, 0.5})
      for (int phase = 0; phase < 40; ++phase) {
        const double height = 2 + per_step * (1 + phase / 40.0);
        const auto seen = run(over_a_row(world_of({}), offset, height, per_step));
        EXPECT_EQ(seen.words.find("approach"), std::string::npos) << seen.words;
        through += !(seen.lowest > 0);
        whole += seen.divided == 0;
      }
  passed.at_most(through, 0);
  divided.at_most(whole, 0);
}

}  // namespace
}  // namespace grseg::hard_cases
