// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/summary.hpp"

#include "sim/scene/deposition.hpp"
#include "sim/scene/geometry.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

std::string text_of(const StepTotals& totals, const Scene& scene, double end = 0, double height = 0)
{
  RunSummary summary;
  summary.totals = totals;
  summary.end = end;
  summary.deposited_height = height > 0 ? height : scene.depth;
  return to_text(summary, scene, {});
}

bool says(const std::string& text, const std::string& words)
{
  return text.find(words) != std::string::npos;
}

TEST(Summary, TellsTheSlopeAtTheEndOfARunThatTurns)
{
  const auto scene = small_chute::scene({"--slope", "20", "--slope-rate", "0.5"});
  EXPECT_TRUE(says(text_of({}, scene, 4), "22 at t = 4 s"));
}

// A run to t = 5 s that goes on from 3 s.
TEST(Summary, TellsThePartOfARunThatContinues)
{
  RunSummary summary;
  summary.simulated = summary.end = 5;
  summary.wall = 1;
  const auto text = [&] { return to_text(summary, small_chute::scene(), {}); };
  EXPECT_TRUE(says(text(), "5 s simulated in 1.0 s (5 s per second)\n"));
  summary.simulated = 2;
  summary.simulated_before = 3;
  summary.wall_before = 0.5;
  EXPECT_TRUE(says(text(),
                   "2 s simulated in 1.0 s (2 s per second), from t = 3 s to 5 s; with the "
                   "part before, 5 s in 1.5 s\n"));
}

// A bed that moves like a block, by 0.1 m/s.
TEST(Summary, TellsHowTheBedMovesAtTheEnd)
{
  const auto scene = small_chute::scene();
  auto simulation = release(deposit<2>(scene), scene);
  const auto& grains = simulation.world().grains;
  double mass = 0, of_diameter = 0, area = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (grains.fixed[g]) continue;
    simulation.set_velocity(g, {0.1, 0});
    mass += grains.mass[g];
    of_diameter += grains.mass[g] * 2 * grains.radius[g];
    area += std::numbers::pi * grains.radius[g] * grains.radius[g];
  }
  const auto end = end_of_flow(simulation, scene, {simulation.time() - 2, 0.04});
  EXPECT_NEAR(end.mean_velocity, 0.1, 1e-12);
  EXPECT_NEAR(end.surface_velocity, 0.1, 1e-12);
  const double height = bed_height(simulation, scene.geometry->boundaries(scene).top);
  EXPECT_NEAR(end.solid_fraction, area / (scene.length * height), 1e-12);
  const double weight = scene.gravity * std::cos(scene.slope * std::numbers::pi / 180);
  EXPECT_NEAR(end.inertial_number * 2 * height * std::sqrt(end.solid_fraction * weight * height),
              5 * 0.1 * of_diameter / mass, 1e-12);
  // From 0.04 to 0.1 m/s in 2 s: 0.03 m/s^2 that friction did not balance.
  const double slope = scene.slope * std::numbers::pi / 180;
  EXPECT_NEAR(end.stress_ratio, std::tan(slope) - 0.03 / weight, 1e-12);
  EXPECT_FALSE(end.is_jammed());
}

/// Text of the summary of a bed all of whose grains stand still.
std::string text_at_rest(const Scene& scene)
{
  auto simulation = release(deposit<2>(scene), scene);
  const auto& fixed = simulation.world().grains.fixed;
  for (std::size_t g = 0; g < fixed.size(); ++g)
    if (!fixed[g]) simulation.set_velocity(g, {0, 0});
  RunSummary summary;
  summary.end_of_flow = end_of_flow(simulation, scene, {-1, 0});
  return to_text(summary, scene, {});
}

TEST(Summary, SaysThatABedAtRestIsJammedUnlessItIsShaken)
{
  EXPECT_TRUE(says(text_at_rest(small_chute::scene()), "remark     the bed is at rest or creeps"));
  EXPECT_FALSE(says(
      text_at_rest(small_chute::scene({"--shake-amplitude", "1mm", "--shake-frequency", "10"})),
      "creeps"));
}

// A bed that gains 1 m/s in a second is balanced to less than 95 %.
TEST(Summary, SaysThatAFlowAccelerates)
{
  const auto scene = small_chute::scene();
  auto simulation = release(deposit<2>(scene), scene);
  const auto& fixed = simulation.world().grains.fixed;
  for (std::size_t g = 0; g < fixed.size(); ++g)
    if (!fixed[g]) simulation.set_velocity(g, {2, 0});
  RunSummary summary;
  summary.end_of_flow = end_of_flow(simulation, scene, {simulation.time() - 1, 1});
  EXPECT_TRUE(says(to_text(summary, scene, {}), "remark     the flow accelerates: "));
  summary.end_of_flow = end_of_flow(simulation, scene, {simulation.time() - 1, 1.9});
  EXPECT_FALSE(says(to_text(summary, scene, {}), "accelerates"));
}

TEST(Summary, ProposesLayersForABedAndCellsForADrum)
{
  EXPECT_TRUE(says(next_steps("run.h5", small_chute::scene()),
                   "grseg-stress run.h5 -o stress.tsv, then grseg-fit stress.tsv\n"));
  EXPECT_TRUE(says(
      next_steps("run.h5", small_chute::paper_scene({"--geometry", "drum", "--lateral", "walls"})),
      "grseg-stress run.h5 --bins xy --layer 2dS -o stress.tsv, then grseg-fit stress.tsv "
      "--component pressure"));
}

TEST(Summary, SaysHowFarABedIsFromItsDepth)
{
  const auto scene = small_chute::scene();
  EXPECT_FALSE(says(text_of({}, scene, 1, 1.019 * scene.depth), "remark"));
  EXPECT_TRUE(says(text_of({}, scene, 1, 1.05 * scene.depth),
                   "remark     the bed is 5 % higher than the depth asked for"));
  EXPECT_TRUE(says(text_of({}, scene, 1, 0.95 * scene.depth), "is 5 % lower"));
}

TEST(Summary, DoubtsOneDeepOverlapAmongManyShallowOnes)
{
  const auto scene = small_chute::scene();
  StepTotals totals;
  totals.touching = 1e6;
  totals.largest_overlap = 0.24 * scene.small_diameter;
  EXPECT_FALSE(says(text_of(totals, scene), "doubt"));
  totals.largest_overlap = 0.26 * scene.small_diameter;
  EXPECT_TRUE(says(text_of(totals, scene), "doubt      a grain overlapped another"));
}

TEST(Summary, CountsOneStepAsOne)
{
  const auto scene = small_chute::scene();
  StepTotals totals;
  totals.missed = totals.divided = totals.solved_again = 1;
  EXPECT_TRUE(says(text_of(totals, scene), "doubt      1 step missed the tolerance"));
  EXPECT_TRUE(says(text_of(totals, scene), "remark     1 step was divided into parts"));
  EXPECT_TRUE(says(text_of(totals, scene), "remark     1 step was solved again"));
  totals.missed = totals.divided = totals.solved_again = 2;
  EXPECT_TRUE(says(text_of(totals, scene), "doubt      2 steps missed the tolerance"));
  EXPECT_TRUE(says(text_of(totals, scene), "remark     2 steps were divided into parts"));
  EXPECT_TRUE(says(text_of(totals, scene), "remark     2 steps were solved again"));
}

TEST(Summary, SaysWhatTheStepsThatMissedTheToleranceDid)
{
  const auto scene = small_chute::scene();
  StepReport met, missed, after;
  met.largest_impulse = after.largest_impulse = 2;
  met.largest_overlap = 0.2 * scene.small_diameter;
  missed.solver.converged = false;
  missed.largest_impulse = 14;
  missed.largest_overlap = 0.1 * scene.small_diameter;
  missed.energy_gain = 5;
  after.largest_overlap = 0.03 * scene.small_diameter;
  met.solver.converged = after.solver.converged = true;
  StepTotals totals;
  for (const auto& step : {met, missed, after, met}) totals.add(step);
  // The bed of this test has no grains, and so no weight.
  EXPECT_TRUE(
      says(text_of(totals, scene),
           "1 step missed the tolerance of the solver. There, the largest force was 7 times "
           "its mean over other steps, contacts added at most 5.0e+00 J of energy, overlaps "
           "just after were up to 3.0e-02 d_S"));
}

}  // namespace
}  // namespace grseg
