// SPDX-License-Identifier: GPL-3.0-or-later
// Autocorrelation times and standard errors of series short enough for calculation by hand.
#include "analysis/statistics/correlated_windows.hpp"
#include "analysis/statistics/exponential_approach.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

namespace grseg {
namespace {

/// Three times +1, three times -1, twice. Correlations 5/12 at lag 1, -2/12 at lag 2, -9/12 at lag 3.
Eigen::VectorXd in_threes()
{
  Eigen::VectorXd series(12);
  series << 1, 1, 1, -1, -1, -1, 1, 1, 1, -1, -1, -1;
  return series;
}

// Kendall's correction: rho = (12 x 5/12 + 1)/(12 - 3) = 2/3, and (1 + 2/3)/(1 - 2/3) = 5. The sum
// ends at lag 3, where it is 1 + 2 (5 - 2 - 9)/12 = 0.
TEST(AutocorrelationByHand, TheTimeFromNeighboursIsFreedOfItsBias)
{
  EXPECT_NEAR(autocorrelation_time(in_threes(), {12}), 5, 1e-12);
}

// x_k = e_k + e_(k-2): no correlation between neighbours, 1/2 at lag 2, hence the time 1 + 2/2. An
// AR(1) series with the same correlation of neighbours would be independent.
TEST(AutocorrelationByHand, WhatNeighboursDoNotTellIsSummedOnBothSides)
{
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  constexpr Eigen::Index n = 20000;
  Eigen::VectorXd kick(n + 2);
  for (auto& value : kick) value = normal(random);
  EXPECT_NEAR(autocorrelation_time(kick.head(n) + kick.tail(n), {n}), 2, 0.15);
}

// Correlations 3/6 at lag 2, 0 at lag 4, -3/6 at lag 6. The sum ends there, because 6 is not less
// than five times 1 + 2 (3 + 0 - 3)/6 = 1; the correction is 1 + (2 x 6 + 1)/12. From neighbours
// alone the time would be 1.25.
TEST(AutocorrelationByHand, TheSumIsFreedOfWhatSubtractingTheMeanTakes)
{
  Eigen::VectorXd series(12);
  series << 1, 0, 1, 0, 1, 0, -1, 0, -1, 0, -1, 0;
  EXPECT_NEAR(autocorrelation_time(series, {12}), 25. / 12, 1e-12);
}

// 12 windows worth 12/5 independent ones, less one fitted mean: 1.4 degrees; variance 12 x 5 x 2.4/1.4.
TEST(StandardErrorByHand, IsThatOfIndependentWindowsTimesTheRootOfTheTime)
{
  const auto error = standard_error(in_threes(), 1);
  EXPECT_NEAR(error.degrees, 1.4, 1e-12);
  EXPECT_NEAR(error.error, std::sqrt(12 * 5 * 2.4 / 1.4), 1e-12);
}

// Differences of neighbours are 2, 2, 2; half the sum of their squares is 6. The variance is 4/3 of it
// with 2/3 x 3 degrees of freedom, for which Student's quantile is 4.302653.
TEST(StandardErrorByHand, AboutATrendIsFromHalfTheSquaredDifferencesOfNeighbours)
{
  const auto error = error_about_trend(Eigen::Vector4d(1, -1, 1, -1));
  EXPECT_NEAR(error.degrees, 2, 1e-12);
  EXPECT_NEAR(error.error, std::sqrt(8.), 1e-12);
  const auto around = error.around(5);
  EXPECT_NEAR(around.high - 5, 4.302653 * std::sqrt(8.), 1e-5);
  EXPECT_NEAR(5 - around.low, 4.302653 * std::sqrt(8.), 1e-5);
}

// The density of Student's t with 0.5 degrees of freedom is Gamma(3/4)/(sqrt(pi/2) Gamma(1/4)) (1 + 2
// t^2)^(-3/4). Far out, the tail is this constant times 2^(-3/4) t^(-1/2) 2, which is 0.025 at t = 164.56.
TEST(StandardErrorByHand, WithHalfADegreeThereIsAnIntervalAndWithLessThereIsNone)
{
  constexpr double pi = 3.14159265358979324;
  const double density = std::tgamma(0.75) / (std::sqrt(pi / 2) * std::tgamma(0.25));
  const double quantile = std::pow(density * 2 * std::pow(2, -0.75) / 0.025, 2);
  EXPECT_NEAR((StandardError{1, 0.5}).reach() / quantile, 1, 1e-4);
  EXPECT_TRUE(std::isnan((StandardError{1, 0.49}).reach()));
  EXPECT_TRUE(std::isnan((StandardError{1, 0.49}).around(5).low));
  EXPECT_EQ((StandardError{2, 0.5}).around(5).high, (StandardError{2, 0.5}).around(5).high);
}

// Eleven points on an exponential plus deviations that no change of its three parameters can
// imitate: the scatter is the root of the sum of squares over 11 - 3.
TEST(ExponentialApproachByHand, ItsScatterCountsThreeFittedNumbers)
{
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(11, 0, 3);
  const Eigen::ArrayXd decay = (-x.array()).exp();
  Eigen::MatrixX3d tangents(11, 3);
  tangents.col(0) = decay;
  tangents.col(1) = 1 - decay;
  tangents.col(2) = x.array() * decay;
  Eigen::VectorXd off(11);
  for (Eigen::Index k = 0; k < 11; ++k) off[k] = k % 2 == 0 ? 1e-4 : -1e-4;
  off -= tangents * (tangents.transpose() * tangents).ldlt().solve(tangents.transpose() * off);
  const auto fit = fit_approach(x, 1 - decay.matrix().array() + off.array());
  ASSERT_EQ(fit.trouble, "");
  EXPECT_NEAR(fit.scatter / std::sqrt(off.squaredNorm() / 8), 1, 1e-3);
}

}  // namespace
}  // namespace grseg
