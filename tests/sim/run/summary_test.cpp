// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/summary.hpp"

#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>

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
