// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/bootstrap.hpp"

#include "tests/analysis/correlated_windows.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

using namespace synthetic;

double half_width(const Estimate& interval)
{
  return (interval.high - interval.low) / 2;
}

Estimate interval_of_mean(const Eigen::VectorXd& series, const RunLengths& runs,
                          std::size_t samples)
{
  return mean_of(series, Bootstrap(runs, samples, 1)).interval;
}

/// Number of trials; Coverage counts those in which an interval contains the truth.
constexpr int trials = 500;
struct Coverage {
  double interval = 0, plain = 0;
};

Coverage coverage_of_mean(double rho, const RunLengths& runs, double run_scatter)
{
  Ar1 noise(rho);
  Coverage share;
  for (int k = 0; k < trials; ++k) {
    const auto verdict = mean_of(noise.series(runs, run_scatter),
                                 Bootstrap(runs, 200, 1 + static_cast<unsigned>(k)));
    share.interval += holds(verdict.interval, 0) / double{trials};
    share.plain += holds(verdict.plain, 0) / double{trials};
  }
  return share;
}

/// Bounds of an observed coverage if the true one is 93 to 97 %: three standard deviations of the
/// binomial distribution on either side.
constexpr double trial_count = trials;
const double least = 0.93 - 3 * std::sqrt(0.93 * 0.07 / trial_count);  // 0.896
const double most = 0.97 + 3 * std::sqrt(0.97 * 0.03 / trial_count);   // 0.993

// tau = (1 + rho)/(1 - rho); the estimate from 20000 windows is accurate to a few per cent.
TEST(Autocorrelation, TimeOfAFirstOrderSeriesIsTheKnownOne)
{
  for (const double rho : {0.0, 0.5, 0.8})
    EXPECT_NEAR(autocorrelation_time(Ar1(rho).series(20000), {20000}) * (1 - rho) / (1 + rho), 1,
                0.15);
}

TEST(Autocorrelation, TwoRunsOfDifferentMeanAreNotTakenForOneCorrelatedRun)
{
  Eigen::VectorXd both = Ar1(0).series(400);
  both.head(200).array() += 5;
  EXPECT_LT(autocorrelation_time(both, {200, 200}), 1.5);
  EXPECT_GT(autocorrelation_time(both, {400}), 20);
}

TEST(Autocorrelation, AnAlternatingOrConstantSeriesCountsAsIndependent)
{
  Eigen::VectorXd alternating(100);
  for (Eigen::Index k = 0; k < 100; ++k) alternating[k] = k % 2 == 0 ? 1 : -1;
  EXPECT_EQ(autocorrelation_time(alternating, {100}), 1);
  EXPECT_EQ(autocorrelation_time(Eigen::VectorXd::Ones(100), {100}), 1);
}

// rho = 1/2, n = 120: (sqrt(6)/2/(3/4))^(2/3) 120^(1/3) = 1.387 x 4.932 = 6.84.
TEST(Autocorrelation, BlockLengthFollowsCarlsteinsRule)
{
  EXPECT_EQ(block_length(3, {120}), 7u);
  EXPECT_EQ(block_length(3, {120, 120}), 7u);
  EXPECT_EQ(block_length(1, {120}), 1u);
  EXPECT_EQ(block_length(1000, {16}), 8u);       // two blocks remain
  EXPECT_EQ(block_length(1000, {16, 16}), 10u);  // three for two runs
}

TEST(Bootstrap, ASampleHasAsManyWindowsAsTheRunAndBlocksAreConsecutive)
{
  const Bootstrap bootstrap({10, 7}, 50, 3);
  for (const std::size_t length : {1u, 3u, 7u}) {
    const auto& times = bootstrap.blocks(length);
    ASSERT_EQ(times.rows(), 50);
    for (Eigen::Index k = 0; k < times.rows(); ++k) {
      EXPECT_EQ(times.row(k).head(10).sum(), 10);
      EXPECT_EQ(times.row(k).tail(7).sum(), 7);
    }
  }
  // With a block as long as the run there is only one choice.
  EXPECT_EQ(bootstrap.blocks(10), Eigen::MatrixXd::Ones(50, 17));
  // Blocks of 3 in 10 windows: window 0 is drawn only together with window 1.
  const auto& threes = bootstrap.blocks(3);
  for (Eigen::Index k = 0; k < threes.rows(); ++k)
    EXPECT_LE(threes(k, 0), threes(k, 1) + 1);  // the last of four blocks is cut to one window
}

TEST(Bootstrap, WholeRunsAreDrawnAsAWhole)
{
  const Bootstrap bootstrap({3, 2, 4}, 200, 3);
  const auto& times = bootstrap.whole_runs();
  ASSERT_EQ(times.rows(), 200);
  for (Eigen::Index k = 0; k < times.rows(); ++k) {
    EXPECT_EQ(times(k, 0), times(k, 2));
    EXPECT_EQ(times(k, 5), times(k, 8));
    EXPECT_EQ(times(k, 0) + times(k, 3) + times(k, 5), 3);
  }
  EXPECT_EQ(Bootstrap({9}, 200, 3).whole_runs().rows(), 0);
}

TEST(Bootstrap, TheSameSeedDrawsTheSameInAnyOrderOfCalls)
{
  const Bootstrap a({30, 20}, 100, 5), b({30, 20}, 100, 5), other({30, 20}, 100, 6);
  a.blocks(2);
  a.whole_runs();
  EXPECT_EQ(a.blocks(4), b.blocks(4));
  EXPECT_EQ(b.blocks(2), a.blocks(2));
  EXPECT_EQ(a.whole_runs(), b.whole_runs());
  EXPECT_NE(a.blocks(4), other.blocks(4));
}

// Independent windows, drawn one by one: the standard error of a mean is s/sqrt(n), and the interval is
// Student's. 4000 samples determine it to 1/sqrt(8000) = 1.1 %; the tolerance is three times that.
TEST(Bootstrap, IndependentWindowsGiveStudentsIntervalOfTheMean)
{
  const double n = 50;
  const Eigen::VectorXd series = Ar1(0).series(50);
  const Bootstrap bootstrap({50}, 4000, 1);
  const Dependence independent{1, 1, n, 1};
  const auto interval =
      bootstrap.window_error(sampled_means(bootstrap.blocks(1), series), independent)
          .around(series.mean());
  const double s = std::sqrt((series.array() - series.mean()).square().sum() / (n - 1));
  const double expected = gsl_cdf_tdist_Pinv(0.975, n - 1) * s / std::sqrt(n);
  EXPECT_NEAR(half_width(interval) / expected, 1, 0.034);
  EXPECT_NEAR(interval.low + interval.high, 2 * series.mean(), 1e-12);
}

Eigen::VectorXd plus_and_minus_one()
{
  Eigen::VectorXd samples(100);  // samples of variance 100/99
  for (Eigen::Index k = 0; k < 100; ++k) samples[k] = k % 2 == 0 ? 1 : -1;
  return samples;
}

// tau = 3, i.e. rho = 1/2: blocks of 4 and 40 effective windows are m = 10 blocks, so the factor is
// 10/9 for the fitted mean. At the ends of blocks 1 - (1 - 1/16)/(4 x 3/4) = 11/16 of the variance
// is kept; Student's t has 9 degrees of freedom.
TEST(Bootstrap, AnIntervalOfWindowsByHand)
{
  const auto interval =
      Bootstrap({40}, 100, 1).window_error(plus_and_minus_one(), {3, 4, 40, 1}).around(5);
  EXPECT_NEAR(half_width(interval), 2.262157 * std::sqrt(100. / 99 * 10 / 9 * 16 / 11), 1e-6);
  EXPECT_NEAR(interval.low + interval.high, 10, 1e-12);
}

// 4 runs: the factor is 4/3 for their mean, t has 3 degrees of freedom. Windows and their
// correlation have no effect.
TEST(Bootstrap, AnIntervalOfRunsByHand)
{
  const Bootstrap bootstrap({10, 10, 10, 10}, 100, 1);
  const auto interval = bootstrap.run_error(plus_and_minus_one(), {3, 4, 40, 4}).around(5);
  EXPECT_NEAR(half_width(interval), 3.182446 * std::sqrt(100. / 99 * 4 / 3), 1e-6);
  EXPECT_NEAR(interval.low + interval.high, 10, 1e-12);
}

// Weights 2, 1 and 1 in runs of 1, 2 and 1 windows: effective number (2 + 2 + 1)^2/(4 + 4 + 1).
TEST(Bootstrap, ARunCountsByItsWeight)
{
  const Eigen::Vector4d weight(2, 1, 1, 1);
  EXPECT_DOUBLE_EQ(dependence(Eigen::Vector4d::Zero(), weight, {1, 2, 1}).effective_runs, 25. / 9);
}

TEST(Coverage, OfTheMeanOfAHundredAndTwentyWindowsIsAsSaid)
{
  for (const double rho : {0.0, 0.5, 0.8}) {
    const auto share = coverage_of_mean(rho, {120}, 0);
    EXPECT_GT(share.interval, least) << rho;
    EXPECT_LT(share.interval, most) << rho;
  }
}

TEST(Coverage, OfPlainPercentilesOfCorrelatedWindowsIsTooLow)
{
  EXPECT_LT(coverage_of_mean(0.8, {120}, 0).plain, least);
}

// 8 runs of 24 windows; a run's mean has the error sqrt(3/24) = 0.35. Runs are equal, or differ by
// three times that.
TEST(Coverage, OfSeveralRunsIsAsSaidWhetherOrNotTheyDiffer)
{
  const RunLengths runs(8, 24);
  for (const double run_scatter : {0.0, 1.0}) {
    const auto share = coverage_of_mean(0.5, runs, run_scatter);
    EXPECT_GT(share.interval, least) << run_scatter;
    EXPECT_LT(share.interval, most) << run_scatter;
  }
}

TEST(Coverage, OfTheStrengthOfSegregationIsThatOfAMean)
{
  Ar1 noise(0.8);
  const double truth = ScatteredStress::truth(0).B;
  double share = 0;
  for (int k = 0; k < trials; ++k) {
    const auto fit = fit_rule(ScatteredStress::windows({120}, 0, noise), {}, {},
                              Bootstrap({120}, 200, 1 + static_cast<unsigned>(k)));
    share += holds(fit.estimate(&Estimators::B), truth) / trial_count;
  }
  EXPECT_GT(share, least);
  EXPECT_LT(share, most);
}

// While layers segregate, their compositions drift. If B depends on composition, so do the values
// of the windows. This trend is not noise: independent windows stay independent, and the interval
// is as narrow as their scatter allows.
TEST(Coverage, OfAFlowThatSegregatesIsThatOfASteadyOne)
{
  Ar1 noise(0.5);
  const auto known = ScatteredStress::drifting(120, nullptr);
  const double truth = estimators_of(fit_points(known, {}, {})).B;
  double share = 0, time = 0;
  for (int k = 0; k < trials; ++k) {
    const auto fit = fit_rule(ScatteredStress::drifting(120, &noise), {}, {},
                              Bootstrap({120}, 200, 1 + static_cast<unsigned>(k)));
    share += holds(fit.estimate(&Estimators::B), truth) / trial_count;
    time += fit.dependence.time / trial_count;
  }
  EXPECT_GT(share, least);
  EXPECT_LT(share, most);
  EXPECT_NEAR(time, 3, 1);
}

TEST(Bootstrap, CorrelatedWindowsAreDrawnInLongerBlocks)
{
  EXPECT_GE(dependence_of_mean(Ar1(0.7).series(120), {120}).block, 5u);
  EXPECT_LE(dependence_of_mean(Ar1(0).series(120), {120}).block, 3u);
}

// The variance of a mean of n windows is tau/n; one long series determines it accurately.
TEST(Bootstrap, CorrelationWidensTheIntervalByTheRootOfItsTime)
{
  const auto interval = interval_of_mean(Ar1(0.8).series(5000), {5000}, 2000);
  EXPECT_NEAR(half_width(interval) / (1.96 * std::sqrt(9.0 / 5000)), 1, 0.2);
}

TEST(Bootstrap, RunsThatDifferWidenTheIntervalToThatOfTheirMeans)
{
  Eigen::VectorXd series = 0.01 * Ar1(0).series(160);
  const double shift[] = {-0.9, 0.3, 1.2, -0.6};  // standard deviation sqrt(2.7/3)
  for (Eigen::Index run = 0; run < 4; ++run) series.segment(40 * run, 40).array() += shift[run];
  const auto interval = interval_of_mean(series, {40, 40, 40, 40}, 4000);
  const double expected = gsl_cdf_tdist_Pinv(0.975, 3) * std::sqrt(2.7 / 3) / 2;
  EXPECT_NEAR(half_width(interval) / expected, 1, 0.05);
}

TEST(Bootstrap, TooFewWindowsHaveNoInterval)
{
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  EXPECT_TRUE(std::isnan(interval_of_mean(one, {1}, 200).low));
  // Many windows, only one of which has weight.
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(50);
  weight[3] = 1;
  EXPECT_EQ(dependence(Eigen::VectorXd::Zero(50), weight, {50}).effective_windows, 1);
}

// Student's factor for two observations is 12.7; means 0 and 1, standard error 1/2.
TEST(Bootstrap, TwoRunsOfOneWindowEachAreTwoObservations)
{
  const auto interval = interval_of_mean(Eigen::Vector2d(0, 1), {1, 1}, 4000);
  EXPECT_NEAR(half_width(interval) / (12.7062 / 2), 1, 0.04);
}

TEST(Bootstrap, DoubtIsVoicedWhereWindowsAreTooFewForTheirCorrelation)
{
  EXPECT_EQ(Bootstrap({120}, 200, 1).doubt({5, 10, 120, 1}), "");
  const Bootstrap one_run({48}, 200, 1);
  EXPECT_EQ(
      one_run.doubt({5, 10, 48, 1}),
      "48 windows are too few to measure how long they are correlated; with fewer than 120 an "
      "interval of 95 % over windows contains the true value less often if that time is longer");
  EXPECT_EQ(one_run.doubt({12, 10, 48, 1}),
            "48 windows with an autocorrelation time of 12 windows are worth 4 independent ones; "
            "with fewer than 8 an interval of 95 % contains the true value less often");
  EXPECT_TRUE(one_run.doubt({12, 48, 48, 1}).ends_with("; too few for an interval"));
  EXPECT_EQ(Bootstrap({48}, 0, 1).doubt({12, 10, 48, 1}), "");
  EXPECT_EQ(
      Bootstrap({3}, 200, 1).doubt({1, 1, 3, 1}),
      "3 windows with an autocorrelation time of 1 window are worth 3 independent ones; with fewer "
      "than 8 an interval of 95 % contains the true value less often");
  EXPECT_EQ(
      Bootstrap({3}, 200, 1).doubt({3, 3, 3, 1}),
      "3 windows with an autocorrelation time of 3 windows are worth 1 independent one; too few for "
      "an interval");
  EXPECT_TRUE(Bootstrap({8}, 200, 1).doubt({1, 1, 8, 1}).starts_with("8 windows are too few"));
}

TEST(Bootstrap, OneWindowIsOneObservation)
{
  EXPECT_EQ(Bootstrap({1}, 200, 1).doubt({1, 1, 1, 1}),
            "one window is one observation, too few for an interval");
}

// Eight runs of ten windows; three windows have the information of one.
TEST(Bootstrap, DoubtIsVoicedWhereEachRunIsTooShortForItsCorrelation)
{
  const Bootstrap bootstrap(RunLengths(12, 10), 200, 1);
  EXPECT_TRUE(bootstrap.doubt_of_windows({3, 2, 120, 12})
                  .starts_with("the windows of each run are worth 3.3 independent ones"));
  EXPECT_EQ(bootstrap.doubt_of_windows({1.5, 1, 120, 12}), "");
}

TEST(Bootstrap, DoubtIsVoicedWhereRunsAreTooFew)
{
  EXPECT_EQ(Bootstrap({48, 48}, 200, 1).doubt({1, 1, 96, 2}),
            "2 runs, worth 2 of equal weight, show little of how runs differ; more runs give a "
            "narrower interval");
  EXPECT_EQ(Bootstrap(RunLengths(4, 48), 200, 1).doubt({1, 1, 192, 4}), "");
}

TEST(Bootstrap, WithoutSamplesThereIsNoInterval)
{
  EXPECT_TRUE(std::isnan(interval_of_mean(Ar1(0).series(50), {50}, 0).low));
}

}  // namespace
}  // namespace grseg
