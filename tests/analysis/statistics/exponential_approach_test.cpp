// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/exponential_approach.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace grseg {
namespace {

Eigen::VectorXd frames(Eigen::Index count, double interval, double first = 0)
{
  return Eigen::VectorXd::LinSpaced(count, first,
                                    first + static_cast<double>(count - 1) * interval);
}

/// Residuals as in a bed: an AR(1) series of standard deviation `size`.
Eigen::VectorXd noise(Eigen::Index count, double size, double correlation, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> kick(0, size * std::sqrt(1 - correlation * correlation));
  Eigen::VectorXd series(count);
  double last = std::normal_distribution<double>(0, size)(random);
  for (auto& value : series) value = last = correlation * last + kick(random);
  return series;
}

Eigen::VectorXd rise(const Eigen::VectorXd& x, double start, double end, double scale)
{
  return end - (end - start) * (-(x.array() - x[0]) / scale).exp();
}

// Also if the run is much longer or shorter than the time, and if the series falls.
TEST(ExponentialApproach, ATimeIsFoundToRoundOff)
{
  for (const double scale : {0.8, 12.0, 60.0, 400.0})
    for (const auto& [start, end] : {std::pair{0.05, 0.22}, {0.25, 0.1}}) {
      const auto t = frames(1201, 0.05, 5);
      const auto fit = fit_approach(t, rise(t, start, end, scale));
      ASSERT_EQ(fit.trouble, "");
      EXPECT_NEAR(fit.scale.value, scale, 1e-8 * scale);
      EXPECT_NEAR(fit.start.value, start, 1e-9);
      EXPECT_NEAR(fit.end.value, end, 1e-8);
    }
}

// These are times that the search tries first.
TEST(ExponentialApproach, AFirstGuessThatIsRightIsKept)
{
  const auto t = frames(1201, 0.05);
  for (int power = -2; power <= 4; ++power)
    for (int level = 1; level <= 20; ++level) {
      const double scale = std::ldexp(60, -power);
      const auto fit = fit_approach(t, rise(t, 0.01 * level, 0.5 - 0.007 * level, scale));
      ASSERT_EQ(fit.trouble, "") << scale << " s at level " << level;
      EXPECT_NEAR(fit.scale.value, scale, 1e-8 * scale);
    }
}

TEST(ExponentialApproach, HalfAndNineTenthsAreLogarithms)
{
  const auto t = frames(8001, 0.01, 3);
  const auto y = rise(t, 0.05, 0.22, 12);
  const auto fit = fit_approach(t, y);
  EXPECT_NEAR(time_to(0.5, fit, t, y).value, 12 * std::log(2.0), 1e-5);
  EXPECT_NEAR(time_to(0.9, fit, t, y).value, 12 * std::log(10.0), 1e-5);
}

TEST(ExponentialApproach, AWayThatIsNotGoneHasNoTime)
{
  const auto t = frames(500, 0.05);  // 25 s, two of three time constants of ln 10
  const auto y = rise(t, 0.05, 0.22, 15);
  const auto fit = fit_approach(t, y);
  EXPECT_NEAR(time_to(0.5, fit, t, y).value, 15 * std::log(2.0), 1e-4);
  EXPECT_TRUE(std::isnan(time_to(0.9, fit, t, y).value));
}

// 95 of 100, within three standard deviations of such a count; estimating the correlation costs a
// little coverage.
TEST(ExponentialApproach, TheIntervalHoldsTheTruthOfCorrelatedResiduals)
{
  const auto t = frames(1000, 0.06);
  for (const double correlation : {0.0, 0.9, 0.98}) {
    int scale = 0, end = 0, half = 0;
    for (unsigned seed = 1; seed <= 200; ++seed) {
      const Eigen::VectorXd y = rise(t, 0.05, 0.22, 15) + noise(t.size(), 0.002, correlation, seed);
      const auto fit = fit_approach(t, y);
      ASSERT_EQ(fit.trouble, "");
      const auto holds = [](const Estimate& e, double truth) {
        return e.low <= truth && truth <= e.high;
      };
      scale += holds(fit.scale, 15) ? 1 : 0;
      end += holds(fit.end, 0.22) ? 1 : 0;
      half += holds(time_to(0.5, fit, t, y), 15 * std::log(2.0)) ? 1 : 0;
    }
    EXPECT_GE(scale, 176) << correlation;
    EXPECT_LE(scale, 199) << correlation;
    EXPECT_GE(end, 176) << correlation;
    EXPECT_GE(half, 176) << correlation;
  }
}

TEST(ExponentialApproach, AStraightLineHasNoTime)
{
  const auto t = frames(400, 0.05);
  const Eigen::VectorXd y = 0.05 + 0.003 * t.array() + noise(t.size(), 0.002, 0.5, 7).array();
  const auto fit = fit_approach(t, y);
  EXPECT_EQ(fit.trouble, "cannot be distinguished from a straight line");
  EXPECT_TRUE(std::isnan(fit.scale.value));
  EXPECT_TRUE(std::isnan(time_to(0.5, fit, t, y).value));
}

TEST(ExponentialApproach, WhatCannotBeFittedSaysWhy)
{
  EXPECT_EQ(fit_approach(frames(7, 1), frames(7, 1)).trouble, "has too few frames");
  EXPECT_EQ(fit_approach(frames(50, 1), Eigen::VectorXd::Constant(50, 0.1)).trouble,
            "does not change");
  Eigen::VectorXd broken = frames(50, 1);
  broken[20] = std::nan("");
  EXPECT_EQ(fit_approach(frames(50, 1), broken).trouble, "is not known in every frame");
  const auto flat = noise(400, 0.01, 0, 3);
  EXPECT_NE(fit_approach(frames(400, 0.05), flat).trouble, "");
}

}  // namespace
}  // namespace grseg
