// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/steady_series.hpp"

#include "tests/analysis/correlated_windows.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

/// Twenty windows: `start`, then pairs of +1 and -1. Neighbours are anticorrelated, so the
/// autocorrelation time is 1.
Eigen::VectorXd alternating(double first, double second)
{
  Eigen::VectorXd series(20);
  for (Eigen::Index k = 0; k < 20; ++k) series[k] = k % 2 == 0 ? 1 : -1;
  series.head(2) << first, second;
  return series;
}

// The last half has ten windows of variance 10/9, so that a mean of the first two windows that lies t
// above it has the error sqrt(10/9 (1/2 + 1/10)) = 0.816, with nine degrees of freedom: 5 % is t = 2.26.
TEST(StartOfFlow, IsComparedWithTheLastHalfByStudentsT)
{
  const double rare = gsl_cdf_tdist_Qinv(0.025, 9) * std::sqrt(10. / 9 * 0.6);
  EXPECT_FALSE(start_of(Series(alternating(rare - 0.01, rare - 0.01)), {20})->is_seen());
  EXPECT_TRUE(start_of(Series(alternating(rare + 0.01, rare + 0.01)), {20})->is_seen());
  EXPECT_TRUE(start_of(Series(alternating(-rare - 0.01, -rare - 0.01)), {20})->is_seen());
}

TEST(StartOfFlow, IsNotFoundInFewWindows)
{
  EXPECT_FALSE(start_of(Series(alternating(9, 9).head(9)), {9}));
  EXPECT_FALSE(
      start_of(Series(Eigen::VectorXd::LinSpaced(40, 0, 1)), {40})->is_known());  // correlated
}

// Without the windows of 9, 9, 8 and 8 nothing differs from the last half.
TEST(StartOfFlow, IsLeftOutByTheLeastPartThatLeavesASteadyRest)
{
  const auto is_steady = [](const Series& rest, const RunLengths& runs) {
    const auto start = start_of(rest, runs);
    return !start || !start->is_seen();
  };
  auto series = alternating(1, -1);
  EXPECT_EQ(start_to_leave_out(Series(series), {20}, is_steady), 0);
  series.head(4) << 9, 9, 8, 8;
  EXPECT_NEAR(start_to_leave_out(Series(series), {20}, is_steady), 0.2, 1e-12);
  EXPECT_EQ(start_to_leave_out(Series(series), {20}, [](auto&...) { return false; }), 1);
}

TEST(StartOfFlow, IsCutFromEachRun)
{
  RunLengths runs{4, 6};
  const auto rest = Series(Eigen::VectorXd::LinSpaced(10, 0, 9)).without_start(0.5, runs);
  EXPECT_EQ(runs, (RunLengths{2, 3}));
  EXPECT_EQ(rest.above, (Eigen::VectorXd(5) << 2, 3, 7, 8, 9).finished());
  EXPECT_EQ(rest.below, Eigen::VectorXd::Ones(5));
}

/// Checks that `alarm` is true for at most the part `chance` of steady series, also for correlated windows and
/// several runs, up to 3.5 standard deviations of a share of so many trials.
template <class Alarm>
void expect_few_alarms(double chance, const Alarm& alarm)
{
  constexpr int trials = 1000;
  const double most = chance + 3.5 * std::sqrt(chance * (1 - chance) / trials);
  for (const auto& runs : {RunLengths{120}, RunLengths{48, 48}}) {
    synthetic::Ar1 noise(0.5);
    int alarms = 0;
    for (int k = 0; k < trials; ++k) alarms += alarm(noise.series(runs, 0), runs);
    EXPECT_LT(alarms, most * trials);
    EXPECT_GT(alarms, 0);
  }
}

TEST(StartOfFlow, ShowsInASteadySeriesAsOftenAsItSays)
{
  expect_few_alarms(rarely, [](const Eigen::VectorXd& series, const RunLengths& runs) {
    return start_of(Series(series), runs)->chance() < rarely;
  });
}

// B is 1 above and below a line that falls from 3 to -3. The two thirds differ by twice 20/29 of 3,
// and the variance of a window about its line is 30/28 (thirty windows less two of the line).
TEST(ChangeInTime, IsTheDifferenceOfThirdsByStudentsT)
{
  Eigen::VectorXd series = Eigen::VectorXd::LinSpaced(30, 3, -3);
  for (Eigen::Index k = 0; k < 30; ++k) series[k] += k % 4 == 0 || k % 4 == 3 ? 1 : -1;
  const auto found = change_of(Series(series), {30});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->first - found->last, 2 * 3 * 20. / 29, 0.01);
  const double t = (found->first - found->last) / std::sqrt(30. / 28 * 2 / 10);
  EXPECT_NEAR(found->chance() / (2 * gsl_cdf_tdist_Q(t, 28)), 1, 0.2);
}

TEST(ChangeInTime, ShowsInASteadySeriesAsOftenAsItSays)
{
  expect_few_alarms(0.05, [](const Eigen::VectorXd& series, const RunLengths& runs) {
    return change_of(Series(series), runs)->is_seen();
  });
}

// A trend of four standard deviations of a window over the run is seen in nearly every trial.
TEST(ChangeInTime, IsSeenInASeriesThatDrifts)
{
  synthetic::Ar1 noise(0.5);
  int seen = 0;
  for (int k = 0; k < 200; ++k) {
    const Eigen::VectorXd b = noise.series(120) + Eigen::VectorXd::LinSpaced(120, 4, 0);
    seen += change_of(Series(b), {120})->is_seen();
  }
  EXPECT_GT(seen, 190);
}

// Three windows of weight 1, 1 and 2: thirds are single windows, whose scatter is not known.
TEST(ChangeInTime, OfFewWindowsHasNoError)
{
  const Eigen::Vector3d above(1, 2, 8), weight(1, 1, 2);
  const auto found = change_of({above, weight}, {3});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->first, 1);
  EXPECT_EQ(found->last, 4);
  EXPECT_FALSE(found->is_known());
  EXPECT_FALSE(found->is_seen());
  EXPECT_FALSE(change_of({above.head(2), weight.head(2)}, {2}));
}

}  // namespace
}  // namespace grseg
