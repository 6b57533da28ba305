// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/deposition.hpp"

#include "formats/cli/tool.hpp"
#include "formats/core/errors.hpp"
#include "sim/step/energies.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <sstream>

namespace grseg {
namespace {

Scene scene_from(const std::vector<std::string>& words)
{
  return small_chute::paper_scene(words);
}

TEST(Deposition, MakesABedOfTheAskedDepthAndComposition)
{
  const auto scene = scene_from(
      {"--depth", "12dS", "--length", "15dL", "--phi-large", "0.4", "--accuracy", "draft"});
  const auto simulation = deposit<2>(scene);
  EXPECT_NEAR(bed_height(simulation), scene.depth, 0.02 * scene.depth);
  const auto& grains = simulation.world().grains;
  double large = 0, all = 0, y_large = 0, y_small = 0;
  int count_large = 0, count_small = 0, base = 0;
  for (std::size_t k = 0; k < grains.size(); ++k) {
    base += grains.species[k] == Species::boundary;
    if (grains.fixed[k]) continue;
    const double area = std::numbers::pi * grains.radius[k] * grains.radius[k];
    const bool is_large = grains.species[k] == Species::large;
    all += area;
    large += is_large ? area : 0;
    (is_large ? y_large : y_small) += simulation.position(k).y();
    ++(is_large ? count_large : count_small);
    EXPECT_NEAR(2 * grains.radius[k], is_large ? 0.01 : 0.005, 0.04 * (is_large ? 0.01 : 0.005));
    EXPECT_GT(simulation.position(k).y(), 0);
  }
  EXPECT_EQ(base, 15);
  EXPECT_NEAR(large / all, 0.4, 0.02);
  EXPECT_LT(y_large / count_large, 0.6 * y_small / count_small);
}

struct Halves {
  double large = 0, small = 0;      // number of grains
  double large_below = 0;           // number of large grains in the lower half of all grains
  double area_large = 0, area = 0;  // m^2
  double height = 0;                // height of the bed, m
  double deviation = 0;             // standard deviation of large_below over random mixtures
};

Halves halves_of(const char* initial, const char* seed)
{
  const auto simulation =
      deposit<2>(scene_from({"--depth", "24dS", "--length", "20dL", "--accuracy", "draft",
                             "--initial", initial, "--seed", seed}));
  const auto& grains = simulation.world().grains;
  std::vector<std::pair<double, bool>> by_height;
  Halves found;
  found.height = bed_height(simulation);
  for (std::size_t k = 0; k < grains.size(); ++k) {
    if (grains.fixed[k]) continue;
    const bool large = grains.species[k] == Species::large;
    by_height.emplace_back(simulation.position(k).y(), large);
    ++(large ? found.large : found.small);
    const double area = std::numbers::pi * grains.radius[k] * grains.radius[k];
    found.area += area, found.area_large += large ? area : 0;
  }
  std::sort(by_height.begin(), by_height.end());
  for (std::size_t k = 0; k < by_height.size() / 2; ++k) found.large_below += by_height[k].second;
  const double all = found.large + found.small;
  found.deviation = std::sqrt(found.large * found.small / (4 * (all - 1)));
  return found;
}

TEST(Deposition, PutsLargeGrainsBelowAmongOrAboveTheSmallOnes)
{
  const auto below = halves_of("large-below", "1"), above = halves_of("large-above", "1");
  EXPECT_EQ(below.large_below, below.large);
  EXPECT_EQ(above.large_below, 0);
  for (const auto* seed : {"1", "2", "3", "4"}) {
    const auto mixed = halves_of("mixed", seed);
    EXPECT_NEAR(mixed.large_below, mixed.large / 2, 2.5 * mixed.deviation) << "seed " << seed;
  }
}

TEST(Deposition, TakesTheSameGrainsHoweverTheyAreOrdered)
{
  for (const auto* initial : {"large-below", "mixed", "large-above"}) {
    const auto bed = halves_of(initial, "1");
    EXPECT_NEAR(bed.height, 0.12, 0.02 * 0.12) << initial;
    EXPECT_NEAR(bed.area_large / bed.area, 0.3, 0.01) << initial;
    EXPECT_NEAR(bed.area / (0.12 * 0.2), 0.81, 0.04) << initial;  // as dense as any deposit
  }
}

/// Kinetic energy per grain, over m g d of a small grain, of a bed that stays level for a second.
double trembling(const std::string& accuracy, const std::string& min_sweeps)
{
  const auto scene = scene_from({"--depth", "40dS", "--length", "10dL", "--accuracy", accuracy});
  auto simulation = deposit<2>(scene);
  const auto loose = scene_from({"--accuracy", accuracy, "--min-sweeps", min_sweeps});
  auto world = simulation.world();
  world.solver = loose.solver;
  simulation = Simulation<2>(world, simulation.state());
  double most = 0;
  while (simulation.time() < 1) {
    simulation.advance();
    if (simulation.time() > 0.5) most = std::max(most, translational_energy(simulation));
  }
  const auto& grains = world.grains;
  const double small = std::numbers::pi / 4 * scene.small_diameter * scene.small_diameter;
  return most / (static_cast<double>(grains.size()) * scene.density * small * scene.gravity *
                 scene.small_diameter);
}

TEST(Deposition, ABedAtRestStaysAtRest)
{
  // Slower than gravity accelerates a grain in one step: (g h)^2/2 = 1.6e-4 g d_S at the step of draft.
  for (const auto* accuracy : {"draft", "standard"})
    EXPECT_LT(trembling(accuracy, "8"), 1e-4) << accuracy;
}

TEST(Deposition, GivesTheWorldTheConditionsOfTheScene)
{
  const auto scene =
      scene_from({"--depth", "6dS", "--length", "6dL", "--origin", "centre", "--rotation", "off",
                  "--density", "3", "--tolerance", "0.3", "--max-sweeps", "77", "--threads", "3"});
  const auto simulation = deposit<2>(scene);
  const auto& world = simulation.world();
  EXPECT_FALSE(world.rotation);
  EXPECT_EQ(world.solver.tolerance, 0.3);
  EXPECT_EQ(world.solver.max_sweeps, 77);
  EXPECT_EQ(world.threads, 3);
  EXPECT_EQ(simulation.time(), 0);
  for (std::size_t k = 0; k < world.grains.size(); ++k) {
    const double r = world.grains.radius[k];
    EXPECT_DOUBLE_EQ(world.grains.mass[k], 3 * std::numbers::pi * r * r);
    if (world.grains.fixed[k]) {
      EXPECT_EQ(simulation.position(k).y(), 0);
    }
  }
}

TEST(Deposition, LargeGrainsAreDenserByTheDensityRatio)
{
  const auto scene = scene_from({"--depth", "6dS", "--length", "6dL", "--density", "3",
                                 "--density-ratio", "1.5", "--phi-large", "0.5"});
  const auto simulation = deposit<2>(scene);
  const auto& grains = simulation.world().grains;
  int large = 0;
  for (std::size_t k = 0; k < grains.size(); ++k) {
    const bool denser = grains.species[k] == Species::large;
    const double r = grains.radius[k];
    EXPECT_DOUBLE_EQ(grains.mass[k], (denser ? 4.5 : 3) * std::numbers::pi * r * r);
    large += denser ? 1 : 0;
  }
  EXPECT_GT(large, 2);
}

TEST(Deposition, IsRecordedBeforeTheTiltWithoutChangingTheBed)
{
  const auto scene = scene_from({"--depth", "6dS", "--length", "6dL", "--accuracy", "draft"});
  std::int64_t steps = 0;
  std::vector<double> times;
  const auto recorded = deposit<2>(
      scene, {.each_step = {},
              .slowed = {},
              .record = [&](const StepReport&, const Simulation<2>&, const Frame<2>* frame) {
                ++steps;
                if (frame != nullptr) times.push_back(frame->time);
              }});
  ASSERT_GE(times.size(), 2u);
  EXPECT_GE(times.front(), -static_cast<double>(steps) * scene.step);
  EXPECT_LT(times.back(), 0);
  EXPECT_NEAR(times[1] - times[0], scene.frame_interval, 1e-12);
  EXPECT_EQ(recorded.position(3), deposit<2>(scene).position(3));
}

TEST(Deposition, BringsElasticGrainsToRestBySlowingThemDown)
{
  // Elastic discs without friction never come to rest by themselves.
  const auto scene = scene_from({"--depth", "6dS", "--length", "8dL", "--friction", "0",
                                 "--restitution", "1", "--accuracy", "draft"});
  double from = 0;
  const auto slowed = [&](double time) { from = from > 0 ? from : time; };
  const auto bed = deposit<2>(scene, {.each_step = {}, .slowed = slowed, .record = {}});
  EXPECT_GE(from, 10 * std::sqrt(2 * scene.depth / scene.gravity));
  EXPECT_LT(translational_energy(bed), potential_energy(bed) / 100);
  EXPECT_EQ(bed.world().material.restitution, 1);
  const auto record = [](const StepReport&, const Simulation<2>&, const Frame<2>*) {};
  const auto recorded = deposit<2>(scene, {.each_step = {}, .slowed = {}, .record = record});
  EXPECT_EQ(recorded.position(3), bed.position(3));
}

TEST(Deposition, EndsWhenItIsAskedTo)
{
  const auto scene = scene_from({"--accuracy", "draft"});
  int steps = 0;
  const auto listen = [&](double) {
    if (++steps == 10) throw ToolError(exit_signal, "interrupted");
  };
  EXPECT_THROW(deposit<2>(scene, {.each_step = listen, .slowed = {}, .record = {}}), ToolError);
  EXPECT_EQ(steps, 10);
}

TEST(Deposition, OfGrainsThatDoNotFitIntoTheirColumnIsRefused)
{
  try {
    deposit<2>(scene_from({"--geometry", "column", "--lateral", "walls", "--column-width", "1dL"}));
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(
        error.what(),
        "the grains do not fit before they fall: the column is too narrow for another one at a "
        "height of 0 m; choose a smaller depth, or a wider column");
  }
}

/// Mean height of the large grains of a mixed, half filled drum, less that of the small ones, over
/// the height of the bed.
template <int D>
double large_above_small(const char* seed)
{
  bool layered = false;
  const auto simulation = deposit<D>(
      scene_from(
          {"--geometry",      "drum", "--lateral", "walls", "--dimension",  std::to_string(D),
           "--drum-diameter", "30dS", "--fill",    "0.5",   "--size-ratio", "1.9",
           "--phi-large",     "0.5",  "--initial", "mixed", "--accuracy",   "draft",
           "--seed",          seed}),
      {.each_step = {}, .slowed = {}, .record = {}, .layered = [&] { layered = true; }});
  EXPECT_TRUE(layered);
  const auto& grains = simulation.world().grains;
  double sum[2]{}, count[2]{}, lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (std::size_t k = 0; k < grains.size(); ++k) {
    if (grains.fixed[k]) continue;
    const double y = simulation.position(k).y();
    const bool large = grains.species[k] == Species::large;
    sum[large] += y, ++count[large];
    lowest = std::min(lowest, y), highest = std::max(highest, y);
  }
  return (sum[1] / count[1] - sum[0] / count[0]) / (highest - lowest);
}

// At size ratio 1.9 a room as wide as a large grain holds one small one, at 2 four (spheres: eight).
// So mixed grains do not fit if each has such a room, and fall in layers of one species. Some five
// layers of large grains at random heights have a mean that deviates by 1/sqrt(12 x 5) = 0.13.
TEST(Deposition, GrainsOfAnySizeRatioFillHalfADrumMixed)
{
  EXPECT_NEAR(large_above_small<2>("1"), 0, 0.39);
  EXPECT_NEAR(large_above_small<3>("1"), 0, 0.39);
}

// In flight a step changes the velocity v to v - g h, or to v/2 - g h if it was halved before.
TEST(Deposition, WhatFallsGoesOnFallingWhileGrainsAreSlowedDown)
{
  const auto scene = scene_from({"--depth", "6dS", "--length", "8dL", "--friction", "0",
                                 "--restitution", "1", "--accuracy", "draft"});
  std::vector<Vec2> before;
  int falling = 0, rising = 0;
  const auto record = [&](const StepReport&, const Simulation<2>& now, const Frame<2>*) {
    const double pull = scene.gravity * scene.step;
    const auto is = [](double a, double b) { return std::abs(a - b) < 1e-9 * std::abs(b); };
    for (std::size_t g = 0; g < before.size(); ++g) {
      const Vec2 old = before[g], v = now.velocity(g);
      if (old.x() == 0 || !is(v.x(), old.x() / 2)) continue;  // in contact, or not slowed
      falling += old.y() < 0 && is(v.y(), old.y() - pull);
      rising += old.y() > 0 && is(v.y(), old.y() / 2 - pull);
      EXPECT_FALSE(old.y() < 0 && is(v.y(), old.y() / 2 - pull));
    }
    before.clear();
    for (std::size_t g = 0; g < now.world().grains.size(); ++g) before.push_back(now.velocity(g));
  };
  deposit<2>(scene, {.each_step = {}, .slowed = {}, .record = record});
  EXPECT_GT(falling, 0);
  EXPECT_GT(rising, 0);
}

// Columns of a dozen discs with restitution 0.9. Their heights vary by more than 2 %, and heavy
// grains throw up light ones. Of seeds 1 to 12, these need most attempts, or most time.
TEST(Deposition, MakesAColumnOfAFewGrainsWithAnySeed)
{
  std::istringstream keys(
      "--geometry column --lateral walls --base wall --column-width 3dL --length 6dL --depth 4dS "
      "--size-ratio 1 --spread 0.4 --phi-large 0.22 --initial mixed --restitution 0.9");
  const std::vector<std::string> common{std::istream_iterator<std::string>(keys), {}};
  for (const auto& [friction, density_ratio, seed] : {std::tuple{"0.5", "1", "1"},
                                                      {"0.5", "1", "3"},
                                                      {"0.5", "1", "6"},
                                                      {"0.5", "1", "11"},
                                                      {"2", "96", "1"},
                                                      {"2", "96", "7"},
                                                      {"2", "96", "8"},
                                                      {"2", "96", "9"}}) {
    auto words = common;
    words.insert(words.end(),
                 {"--friction", friction, "--density-ratio", density_ratio, "--seed", seed});
    const auto scene = scene_from(words);
    EXPECT_NO_THROW(EXPECT_NEAR(bed_height(deposit<2>(scene)), scene.depth, 0.02 * scene.depth))
        << "density ratio " << density_ratio << ", seed " << seed;
  }
}

// The heights of beds of a dozen discs vary by ten per cent. With 4000 sweeps a step, attempts are
// slow, and after three million sweeps one bed within ten per cent is enough.
TEST(Deposition, WhereAttemptsAreSlowTakesTheClosestBed)
{
  const auto scene =
      scene_from({"--geometry",     "column", "--lateral",  "walls", "--base",       "wall",
                  "--column-width", "3dL",    "--length",   "6dL",   "--depth",      "4dS",
                  "--size-ratio",   "1",      "--spread",   "0.4",   "--phi-large",  "0.22",
                  "--initial",      "mixed",  "--accuracy", "draft", "--min-sweeps", "4000",
                  "--max-sweeps",   "4000",   "--seed",     "1"});
  double steps = 0;
  const auto count = [&](double) { ++steps; };
  const auto bed = deposit<2>(scene, {.each_step = count, .slowed = {}, .record = {}});
  const double off = std::abs(bed_height(bed) / scene.depth - 1);
  EXPECT_GT(off, depth_tolerance);
  EXPECT_LT(off, 0.1);
  EXPECT_GT(4000 * steps, 3e6);
  EXPECT_EQ(bed.time(), 0);
}

// Forty large discs in a cell three wide are more than ten diameters high, and none may be left out.
TEST(Deposition, OfLargeGrainsAloneThatAreTooHighGivesUpEarly)
{
  const auto scene = scene_from({"--geometry", "column", "--lateral", "walls", "--base", "wall",
                                 "--column-width", "3dL", "--length", "6dL", "--depth", "8dS",
                                 "--large-grains", "40", "--accuracy", "draft"});
  try {
    deposit<2>(scene);
    FAIL() << "a bed";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("in 5 attempts"), std::string::npos) << error.what();
  }
}

TEST(Deposition, WithoutGrainsIsRefused)
{
  EXPECT_THROW(deposit<2>(scene_from({"--size-ratio", "100", "--phi-large", "1", "--depth", "1dS",
                                      "--length", "4dL", "--base", "wall"})),
               UsageError);
}

// With y = 0 at the centres of the beads, d_L/2 = 1 d_S of the depth is in the base. Numbers of
// grains may differ as much as two depths, by 2 % each.
TEST(Deposition, TheDepthIsCountedFromYZeroAndTheBedBeginsAtTheTopOfTheBase)
{
  const auto grains = [](const char* depth, const char* origin) {
    const auto simulation =
        deposit<2>(scene_from({"--depth", depth, "--length", "20dL", "--accuracy", "draft",
                               "--phi-large", "0", "--origin", origin}));
    return static_cast<double>(simulation.world().grains.size());
  };
  EXPECT_NEAR(grains("13dS", "centre") / grains("12dS", "top"), 1, 0.04);
}

// Small grains on large beads lie in the pockets, on average below y = 0.
TEST(Deposition, OfABedLowerThanItsPocketsIsRefusedOrMade)
{
  const auto scene = scene_from({"--depth", "1dS", "--size-ratio", "10", "--phi-large", "0",
                                 "--length", "4dL", "--accuracy", "draft"});
  try {
    const auto height = bed_height(deposit<2>(scene));
    EXPECT_NEAR(height, scene.depth, 0.02 * scene.depth);
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("only a few grains deep"), std::string::npos);
  }
}

TEST(Deposition, AnotherSeedMakesAnotherBedAndTheSameSeedTheSame)
{
  const auto bed = [](const char* seed) {
    return deposit<2>(
        scene_from({"--depth", "6dS", "--length", "6dL", "--accuracy", "draft", "--seed", seed}));
  };
  const auto first = bed("1"), again = bed("1"), other = bed("2");
  EXPECT_EQ(first.position(3), again.position(3));
  EXPECT_NE(first.position(3), other.position(3));
}

TEST(Deposition, StandsOnAStraightWallBetweenWallsToo)
{
  const auto simulation =
      deposit<2>(scene_from({"--depth", "8dS", "--length", "8dL", "--base", "wall", "--lateral",
                             "walls", "--accuracy", "draft"}));
  for (std::size_t k = 0; k < simulation.world().grains.size(); ++k) {
    EXPECT_FALSE(simulation.world().grains.fixed[k]);
    const double r = simulation.world().grains.radius[k];
    const auto at = simulation.position(k);
    EXPECT_GT(at.y(), 0.9 * r);
    EXPECT_GT(at.x(), 0.9 * r);
    EXPECT_LT(at.x(), simulation.world().box.length_x - 0.9 * r);
  }
}

}  // namespace
}  // namespace grseg
