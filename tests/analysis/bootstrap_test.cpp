// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/bootstrap.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace grseg {
namespace {

/// x_{k+1} = rho x_k + noise, of variance 1 and mean 0; rho = 0 is independent noise.
class Ar1 {
 public:
  explicit Ar1(double rho, unsigned long seed = 7)
      : rng_(gsl_rng_alloc(gsl_rng_ranlxd2), &gsl_rng_free), rho_(rho)
  {
    gsl_rng_set(rng_.get(), seed);
  }
  Eigen::VectorXd series(Eigen::Index length)
  {
    Eigen::VectorXd values(length);
    double value = gsl_ran_gaussian(rng_.get(), 1);
    for (double& place : values) {
      place = value;
      value = rho_ * value + gsl_ran_gaussian(rng_.get(), std::sqrt(1 - rho_ * rho_));
    }
    return values;
  }

 private:
  std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> rng_;
  double rho_;
};

Dependence dependence_of(const Eigen::VectorXd& series, const RunLengths& runs)
{
  return dependence(series.array() - series.mean(), Eigen::VectorXd::Ones(series.size()), runs);
}

Eigen::VectorXd means(const Eigen::MatrixXd& times, const Eigen::VectorXd& series)
{
  if (times.rows() == 0) return {};
  return (times * series).array() / times.rowwise().sum().array();
}

/// The interval of the mean of a series, as a fit would make it.
Interval interval_of_mean(const Eigen::VectorXd& series, const RunLengths& runs,
                          std::size_t samples)
{
  const Bootstrap bootstrap(runs, samples, 1);
  const auto how = dependence_of(series, runs);
  return bootstrap.interval(series.mean(), means(bootstrap.blocks(how.block), series),
                            means(bootstrap.whole_runs(), series), how);
}

double half_width(const Interval& interval)
{
  return (interval.high - interval.low) / 2;
}

/// How often the interval of the mean holds the true mean, 0.
double coverage(double rho, Eigen::Index windows, int series_count)
{
  Ar1 source(rho);
  int holds = 0;
  for (int k = 0; k < series_count; ++k) {
    const auto interval =
        interval_of_mean(source.series(windows), {static_cast<std::size_t>(windows)}, 200);
    holds += interval.low < 0 && interval.high > 0;
  }
  return static_cast<double>(holds) / series_count;
}

// tau = (1 + rho)/(1 - rho); the estimate from 20000 windows is good to some per cent.
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
  // A block as long as the run leaves one choice.
  EXPECT_EQ(bootstrap.blocks(10), Eigen::MatrixXd::Ones(50, 17));
  // Blocks of 3 in 10 windows: window 0 is drawn only together with its neighbour.
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

// Independent windows, drawn singly: the standard error of a mean is s/sqrt(n), and the interval
// Student's. 4000 samples know it to 1/sqrt(8000) = 1.1 %; allowed are three times that.
TEST(Bootstrap, IndependentWindowsGiveStudentsIntervalOfTheMean)
{
  const double n = 50;
  const Eigen::VectorXd series = Ar1(0).series(50);
  const Bootstrap bootstrap({50}, 4000, 1);
  const Dependence independent{1, 1, n};
  const auto interval =
      bootstrap.interval(series.mean(), means(bootstrap.blocks(1), series), {}, independent);
  const double s = std::sqrt((series.array() - series.mean()).square().sum() / (n - 1));
  const double expected = gsl_cdf_tdist_Pinv(0.975, n - 1) * s / std::sqrt(n);
  EXPECT_NEAR(half_width(interval) / expected, 1, 0.034);
  EXPECT_NEAR(interval.low + interval.high, 2 * series.mean(), 1e-12);
}

// Samples at +-1: variance 100/99. tau = 3, blocks of 4, 40 effective windows: m = 10 blocks, so
// 10/9 for the fitted mean, 1/(1 - (3 - 1/3)/8) = 3/2 for the cuts, and t of 9 degrees of freedom.
TEST(Bootstrap, AnIntervalByHand)
{
  Eigen::VectorXd samples(100);
  for (Eigen::Index k = 0; k < 100; ++k) samples[k] = k % 2 == 0 ? 1 : -1;
  const auto interval = Bootstrap({40}, 100, 1).interval(5, samples, {}, {3, 4, 40});
  EXPECT_NEAR(half_width(interval), 2.262157 * std::sqrt(100. / 99 * 10 / 9 * 3 / 2), 1e-6);
  EXPECT_NEAR(interval.low + interval.high, 10, 1e-12);
}

// Two sources of equal variance, 9 and 1 degrees of freedom: Satterthwaite's 4/(1/9 + 1) = 3.6.
TEST(Bootstrap, RunsAndWindowsAddTheirVariances)
{
  Eigen::VectorXd samples(100);
  for (Eigen::Index k = 0; k < 100; ++k) samples[k] = k % 2 == 0 ? 1 : -1;
  const double variance = 100. / 99 * 2;  // times R/(R - 1) = 2 for two runs
  const Eigen::VectorXd blocks = samples * std::sqrt(2 * 9. / 11);  // 11 windows: m/(m - 2) = 11/9
  const auto interval = Bootstrap({6, 5}, 100, 1).interval(0, blocks, samples, {1, 1, 11});
  EXPECT_NEAR(half_width(interval), gsl_cdf_tdist_Pinv(0.975, 3.6) * std::sqrt(2 * variance), 1e-9);
}

// 400 series: a coverage of 0.95 is seen as 0.95 -+ 0.011; allowed are three times that.
TEST(Bootstrap, IntervalsOfIndependentWindowsHoldTheTruthNineteenTimesInTwenty)
{
  EXPECT_NEAR(coverage(0, 120, 400), 0.955, 0.033);
}

TEST(Bootstrap, CorrelatedWindowsAreDrawnInLongerBlocksAndKeepTheirCoverage)
{
  EXPECT_GE(dependence_of(Ar1(0.7).series(120), {120}).block, 5u);
  EXPECT_LE(dependence_of(Ar1(0).series(120), {120}).block, 3u);
  EXPECT_GT(coverage(0.7, 120, 400), 0.91);
}

// The variance of a mean of n windows is tau/n; one long series knows it well.
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
  EXPECT_TRUE(std::isnan(interval_of_mean(Eigen::VectorXd::LinSpaced(2, 0, 1), {1, 1}, 200).low));
  // Many windows of which one alone has weight.
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(50);
  weight[3] = 1;
  EXPECT_EQ(dependence(Eigen::VectorXd::Zero(50), weight, {50}).effective_windows, 1);
}

TEST(Bootstrap, WithoutSamplesThereIsNoInterval)
{
  EXPECT_TRUE(std::isnan(interval_of_mean(Ar1(0).series(50), {50}, 0).low));
}

}  // namespace
}  // namespace grseg
