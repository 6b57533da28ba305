// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/data_doubts.hpp"
#include "tests/analysis/correlated_windows.hpp"
#include "tests/analysis/synthetic_fits.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

/// Twenty windows: 3 and 1, then nine pairs of +1 and -1. Neighbours are anticorrelated, so the
/// autocorrelation time is 1.
Eigen::VectorXd alternating()
{
  Eigen::VectorXd series(20);
  for (Eigen::Index k = 0; k < 20; ++k) series[k] = k % 2 == 0 ? 1 : -1;
  series.head(2) << 3, 1;
  return series;
}

// The mean of the first tenth is 2 above that of the last half, whose ten windows have the variance
// 10/9. The error of the difference is the root of 10/9 (1/2 + 1/10), with nine degrees of freedom.
TEST(StartOfFlow, IsComparedWithTheLastHalfByStudentsT)
{
  const auto found = start_of_flow(alternating(), {20});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->excess, 2, 1e-14);
  EXPECT_NEAR(found->chance, 2 * gsl_cdf_tdist_Q(2 / std::sqrt(10. / 9 * 0.6), 9), 1e-12);
  EXPECT_EQ(found->leave_out, 0);  // 3.6 % is not rare enough
}

TEST(StartOfFlow, IsLeftOutByTheLeastPartThatLeavesASteadyRest)
{
  auto series = alternating();
  series.head(4) << 9, 9, 8, 8;
  const auto found = start_of_flow(series, {20});
  ASSERT_TRUE(found);
  EXPECT_LT(found->chance, 1e-4);
  EXPECT_NEAR(found->leave_out, 0.2, 1e-12);
}

TEST(StartOfFlow, IsNotFoundInFewWindows)
{
  EXPECT_FALSE(start_of_flow(alternating().head(9), {9}));
  EXPECT_FALSE(start_of_flow(Eigen::VectorXd::LinSpaced(40, 0, 1), {40}));  // correlated
}

/// Checks that chance_of(series, runs) is below 2.5 % in at most 2.5 % of steady series, also for
/// correlated windows and several runs, up to 3.5 standard deviations of a share of so many trials.
template <class Chance>
void expect_few_alarms(const Chance& chance_of)
{
  constexpr int trials = 1000;
  const double most = 0.025 + 3.5 * std::sqrt(0.025 * 0.975 / trials);
  for (const auto& runs : {RunLengths{120}, RunLengths{48, 48}}) {
    synthetic::Ar1 noise(0.5);
    int alarms = 0;
    for (int k = 0; k < trials; ++k) alarms += chance_of(noise.series(runs, 0), runs) < 0.025;
    EXPECT_LT(alarms, most * trials);
    EXPECT_GT(alarms, 0);
  }
}

TEST(StartOfFlow, ShowsInASteadySeriesAsOftenAsItSays)
{
  expect_few_alarms([](const Eigen::VectorXd& series, const RunLengths& runs) {
    const auto found = start_of_flow(series, runs);
    return found ? found->chance : 1;
  });
}

// Contacts carry no shear stress in the first 4 of 40 windows, as if grains began to move.
TEST(StartOfFlow, IsSeenInTheShearStressOfAFlowThatGathersSpeed)
{
  auto rows = synthetic::neutral_rows(0.1, 2, 40);
  const auto doubt = [&] {
    return doubt_of_start(synthetic::read({synthetic::stress_table(rows)}), {}, {});
  };
  EXPECT_EQ(doubt(), "");
  for (std::size_t k = 0; k < 4 * synthetic::compositions.size(); ++k)
    for (const auto part : {OwnSum::inside}) {
      for (std::size_t s = 0; s < 2; ++s) rows[k].sums.of(part, s)(0, 1) *= 0.5;
    }
  EXPECT_EQ(doubt().find("|sigma_xy|/sigma_yy is smaller by "), 0u) << doubt();
  EXPECT_NE(doubt().find("--begin 5 leaves the start out"), std::string::npos) << doubt();
}

/// Sums of windows of weight 1 with these B.
WindowSums sums_of(const Eigen::VectorXd& b)
{
  WindowSums windows;
  windows.sums = windows.noise = Eigen::MatrixXd::Zero(b.size(), WindowSums::number_of_sums);
  windows.sums.col(WindowSums::fD) = b;
  windows.sums.col(WindowSums::fQ).setOnes();
  return windows;
}

// B is 1 above and below a line that falls from 3 to -3. The two thirds differ by twice 20/29 of 3,
// and the variance of a window about its line is 30/28 (thirty windows less two of the line).
TEST(ChangeOfB, IsTheDifferenceOfThirdsByStudentsT)
{
  Eigen::VectorXd series = Eigen::VectorXd::LinSpaced(30, 3, -3);
  for (Eigen::Index k = 0; k < 30; ++k) series[k] += k % 4 == 0 || k % 4 == 3 ? 1 : -1;
  const auto found = change_of_b(sums_of(series), {30});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->first - found->last, 2 * 3 * 20. / 29, 0.01);
  const double t = (found->first - found->last) / std::sqrt(30. / 28 * 2 / 10);
  EXPECT_NEAR(found->chance / (2 * gsl_cdf_tdist_Q(t, 28)), 1, 0.2);
}

TEST(ChangeOfB, ShowsInASteadySeriesAsOftenAsItSays)
{
  expect_few_alarms([](const Eigen::VectorXd& series, const RunLengths& runs) {
    const auto found = change_of_b(sums_of(series), runs);
    return found ? found->chance : 1;
  });
}

// A trend of four standard deviations of a window over the run is seen in nearly every trial.
TEST(ChangeOfB, IsSeenWhereBDrifts)
{
  synthetic::Ar1 noise(0.5);
  int seen = 0;
  for (int k = 0; k < 200; ++k) {
    const Eigen::VectorXd b = noise.series(120) + Eigen::VectorXd::LinSpaced(120, 4, 0);
    const auto found = change_of_b(sums_of(b), {120});
    seen += found && found->chance < 0.025;
  }
  EXPECT_GT(seen, 190);
}

}  // namespace
}  // namespace grseg
