// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/estimators.hpp"

#include "analysis/fit/rule_fit.hpp"
#include "tests/analysis/correlated_windows.hpp"
#include "tests/analysis/synthetic_fits.hpp"

#include <gsl/gsl_sf_psi.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace grseg {
namespace {

using synthetic::any_tensor;
using synthetic::fit;
using synthetic::moved;
using synthetic::neutral_data;
using synthetic::neutral_sums;
using synthetic::power_law;
using synthetic::read;
using synthetic::scatter;
using synthetic::separate_sums;
using synthetic::stress_table;
using synthetic::TableRow;

// ---- estimators ---------------------------------------------------------------------------------

TEST(Estimators, AnExactSlopeComesBackFromBothFitsOfThePaper)
{
  const double s = 0.83;
  const auto b = estimators_of(power_law(s, 1));
  EXPECT_NEAR(b.paper_s, s, 1e-13);
  EXPECT_NEAR(b.paper_k, s, 1e-13);
  EXPECT_NEAR(b.paper_a, 1, 1e-13);
  EXPECT_NEAR(b.minus_ln_s, -std::log(s), 1e-13);
  EXPECT_NEAR(b.paper_B, (1 - s + (1 - s) / s) / 2, 1e-13);
}

TEST(Estimators, APowerLawKeepsItsExponentWhateverTheWeights)
{
  const auto b = estimators_of(power_law(1.44, 1.0057));
  EXPECT_NEAR(b.paper_a, 1.0057, 1e-12);
  EXPECT_NEAR(b.paper_k, 1.44, 1e-12);
}

// Staron & Phillips (2015): slope 0.9660 "B between 0.034 and 0.035"; slope 1.4413 "B = -0.373",
// the mean of the ends of a range from -0.4413 to -0.3062.
TEST(Estimators, ThePapersSlopesGiveThePapersB)
{
  EXPECT_NEAR(estimators_of(power_law(0.966, 1)).paper_B, (0.0340 + 0.0352) / 2, 5e-5);
  EXPECT_NEAR(estimators_of(power_law(1.4413, 1)).paper_B, -0.3737, 1e-4);
}

// The relation of Gray & Thornton (2005), psi_L = phi_L (1 + B phi_S).
TEST(Estimators, AConstantBOfGrayAndThorntonIsFoundExactly)
{
  const double b = 0.31;
  auto points = power_law(1, 1);
  for (auto& point : points) {
    const double psi = point.phi_large * (1 + b * (1 - point.phi_large));
    point.total = 5;
    point.large = 5 * psi;
    point.small = 5 * (1 - psi);
  }
  EXPECT_NEAR(estimators_of(points).B, b, 1e-13);
}

// Two layers: (x, y) = (1/4, 1/2) of weight 3 and (4, 2) of weight 1. ln(y/x) = ln 2 and -ln 2, so
// the weighted mean is (3 - 1)/4 ln 2. Power law: the logarithms lie on a line of slope ln 4/ln 16.
TEST(Estimators, TwoLayersByHand)
{
  const std::vector<FitPoint> points{
      {.phi_large = 0.8, .weight = 3, .size_ratio = 2, .small = 1, .large = 2, .total = 3},
      {.phi_large = 0.2, .weight = 1, .size_ratio = 2, .small = 2, .large = 1, .total = 3}};
  const auto b = estimators_of(points);
  EXPECT_NEAR(b.paper_s, std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(b.paper_a, 0.5, 1e-14);
  EXPECT_NEAR(b.paper_k, 1, 1e-14);
}

// Windows of 10 and of 30 frames: B = (10 (2/3 - 4/5) + 30 (1/3 - 1/5))/(40 x 4/25).
TEST(Estimators, BCountsFramesAndNothingElse)
{
  std::vector<FitPoint> points{{.phi_large = 0.8, .weight = 3, .frames = 10, .size_ratio = 2},
                               {.phi_large = 0.2, .weight = 1, .frames = 30, .size_ratio = 2}};
  points[0].small = points[1].large = 1;
  points[0].large = points[1].small = 2;
  points[0].total = points[1].total = 3;
  EXPECT_NEAR(estimators_of(points).B, (10 * (2. / 3 - 0.8) + 30 * (1. / 3 - 0.2)) / 6.4, 1e-14);
}

// Three large grains per layer carry their share of the stress times an exponential variate of mean
// 1, so B = 0. The mean of the logarithm of the mean of n such variates is psi(n) - ln n, with the
// digamma function psi: -0.176 for n = 3. B contains no logarithm.
TEST(Estimators, FewGrainsSpoilTheMeanOfLogarithmsAndNotTheRatioOfSums)
{
  constexpr std::size_t layers = 20000, grains = 3;
  constexpr double phi = 0.02;
  std::mt19937 random(5);
  std::exponential_distribution<double> variate;
  std::vector<FitPoint> points;
  for (std::size_t k = 0; k < layers; ++k) {
    double mean = 0;
    for (std::size_t grain = 0; grain < grains; ++grain) mean += variate(random) / grains;
    FitPoint point{.window = k, .phi_large = phi, .weight = 1, .size_ratio = 2};
    point.large = phi * mean;
    point.small = 1 - point.large;
    point.total = 1;
    points.push_back(point);
  }
  const auto b = estimators_of(points);
  // Standard errors over the layers: 0.0044 for the logarithm, from the root of psi'(3) = 0.395;
  // 0.0041 for the sums, from the root of 1/3.
  EXPECT_NEAR(b.minus_ln_s, gsl_sf_psi_int(grains) - std::log(grains), 4 * 0.0044);
  EXPECT_NEAR(b.B, 0, 4 * 0.0041);
}

TEST(Estimators, SumsOverWindowsSayTheSameAsGslsFitsOfThePoints)
{
  std::vector<FitPoint> points;
  for (std::size_t k = 0; k < 200; ++k) {
    FitPoint point{.window = k % 11, .phi_large = 0.5 + 0.49 * scatter(k), .size_ratio = 2};
    point.weight = 2 + scatter(3 * k);
    point.large = point.phi_large * (1 + 0.2 * scatter(7 * k + 1));
    point.small = 1 - point.phi_large + (k == 17 ? -1 : 0);  // a point whose ratio has no logarithm
    point.total = point.large + point.small;
    points.push_back(point);
  }
  const auto by_points = estimators_of(points);
  const auto by_sums = estimators_from_sums(window_sums(points, {4, 7}).total());
  for (const auto& [name, place] : estimator_columns)
    EXPECT_NEAR(by_sums.*place, by_points.*place, 1e-12) << name;
}

TEST(Estimators, AStressThatIsNotPositiveCountsWhereNoLogarithmIsTaken)
{
  auto points = power_law(0.9, 1);
  const auto before = estimators_of(points);
  points.push_back(
      {.phi_large = 0.02, .weight = 1, .size_ratio = 2, .small = 3, .large = -0.1, .total = 2.9});
  const auto after = estimators_of(points);
  EXPECT_EQ(after.paper_s, before.paper_s);
  EXPECT_LT(after.B, before.B);
}

TEST(Estimators, OneCompositionHasASlopeButNoExponent)
{
  const std::vector<FitPoint> points(
      3, {.phi_large = 0.3, .weight = 1, .size_ratio = 2, .small = 2, .large = 1, .total = 3});
  EXPECT_NEAR(estimators_of(points).paper_s, 2 / (0.7 / 0.3), 1e-14);
  EXPECT_TRUE(std::isnan(estimators_of(points).paper_a));
  EXPECT_TRUE(std::isnan(estimators_from_sums(window_sums(points, {1}).total()).paper_a));
}

// ---- rules on neutral contacts ------------------------------------------------------------------

TEST(NeutralContacts, SharedBySizeDoNotSegregateByAnyEstimator)
{
  const auto data = neutral_data(0);
  for (const char* rule : {"size", "contact-point"})
    for (const auto component : {Component::yy, Component::pressure}) {
      const auto b = fit(data, rule, {.component = component}).value;
      for (const double value : {b.B, b.paper_B, b.minus_ln_s}) EXPECT_NEAR(value, 0, 1e-12);
      EXPECT_NEAR(b.paper_a, 1, 1e-12);
    }
}

TEST(NeutralContacts, SharedOtherwiseShowExactlyTheClosedForm)
{
  const auto data = neutral_data(0);
  for (const char* rule : {"uniform:0.8", "uniform:0.6", "uniform:0.5", "half"}) {
    const auto result = fit(data, rule);
    EXPECT_NEAR(result.value.B, result.neutral, 1e-12) << rule;
    EXPECT_NEAR(result.minus_size.value, result.neutral, 1e-12) << rule;
  }
  EXPECT_EQ(fit(data, "size").neutral, 0);
  EXPECT_EQ(fit(data, "half").neutral, fit(data, "uniform:0.5").neutral);
}

// Under size, sigma^L = phi_L sigma exactly in all layers, so no noise of the sums moves p* from r/(1 + r).
TEST(NeutralContacts, HaveNoBOfSumsAtTheShareBySize)
{
  for (const double r : {1.3, 2.0, 4.0}) {
    const auto data = read({stress_table(synthetic::neutral_rows(0, r), 0.005, 0.005 * r)});
    for (const char* rule : {"size", "half"}) {
      const auto result = fit(data, rule);
      EXPECT_NEAR(result.line.p_zero.value, r / (1 + r), 1e-13);
    }
    EXPECT_NEAR(fit(data, "size").value.B, 0, 1e-13);
  }
}

// With noise, B is still zero if line.p_zero is the share of every contact.
TEST(NeutralContacts, TheZeroOfTheSumsIsOneAndItsIntervalHoldsIt)
{
  const auto data = neutral_data(0.3);
  const auto by_size = fit(data, "size");
  const double zero = by_size.line.p_zero.value;
  EXPECT_NE(zero, 2. / 3);
  const PartitionRule at_zero{PartitionRule::Kind::uniform, zero};
  EXPECT_NEAR(fit_rule(data, at_zero, {}).value.B, 0, 1e-13);
  EXPECT_LT(by_size.line.p_zero.estimate().low, 2. / 3);
  EXPECT_GT(by_size.line.p_zero.estimate().high, 2. / 3);
  // dB/dp = -B/(p* - 2/3), because B is linear in p: both intervals agree.
  const double slope = by_size.value.B / (2. / 3 - zero);
  EXPECT_NEAR((by_size.line.p_zero.estimate().high - by_size.line.p_zero.estimate().low) * slope,
              by_size.high.B - by_size.low.B, 0.05 * (by_size.high.B - by_size.low.B));
}

TEST(NeutralContacts, GiveLargeGrainsTheShareOfTheRule)
{
  const auto data = neutral_data(0.1);
  EXPECT_NEAR(fit(data, "size").share, 2. / 3, 1e-14);
  EXPECT_NEAR(fit(data, "half").share, 0.5, 1e-14);
  EXPECT_NEAR(fit(data, "uniform:0.8").share, 0.8, 1e-14);
  EXPECT_TRUE(std::isnan(fit(data, "drop").share));
}

TEST(NeutralContacts, DisturbedOnesShowInTheDifferenceToSizeWhatTheRuleAdds)
{
  const auto data = neutral_data(0.1);
  const auto size = fit(data, "size"), other = fit(data, "uniform:0.8");
  EXPECT_GT(std::abs(size.value.B), 1e-5);
  EXPECT_NEAR(other.minus_size.value, other.value.B - size.value.B, 1e-15);
  EXPECT_EQ(size.minus_size.value, 0);
}

// r = 2: (0.8 - 2/3) 3/(1 + phi_S), for 30 frames at phi_L = 0.2 and 10 at 0.8, where phi_L phi_S is equal.
TEST(NeutralContacts, TheClosedFormIsAveragedWithTheWeightsOfB)
{
  const auto data =
      read({stress_table({{0, 1, 30, neutral_sums(0.2, 2)}, {0, 1, 10, neutral_sums(0.8, 2)}})});
  const double low = (0.8 - 2. / 3) * 3 / 1.8, high = (0.8 - 2. / 3) * 3 / 1.2;
  EXPECT_NEAR(fit(data, "uniform:0.8").neutral, (3 * low + high) / 4, 1e-14);
}

// Without mixed contacts y = A_SS/A_LL = (x_S/x_L)^2 2/(2 r), and x_S/x_L = r phi_S/phi_L.
TEST(NeutralContacts, DroppedMixedContactsLeaveAParabolaAndNoB)
{
  const auto result = fit(neutral_data(0), "drop");
  EXPECT_NEAR(result.value.paper_a, 2, 1e-12);
  EXPECT_NEAR(result.value.paper_k, 2, 1e-12);
  EXPECT_FALSE(std::isnan(result.value.paper_s));
  for (const auto& [name, place] : estimator_columns)
    EXPECT_EQ(std::isnan(result.value.*place), std::string(name).ends_with('B')) << name;
  EXPECT_TRUE(std::isnan(result.neutral));
  EXPECT_TRUE(std::isnan(result.minus_size.value));
}

// ---- intervals ----------------------------------------------------------------------------------

// One layer per window, all with one composition and weight: minus_ln_s is the plain mean of -ln(y/x),
// so its interval is that of a mean.
TEST(Intervals, OfOneRunAreThoseOfAMean)
{
  std::vector<TableRow> rows;
  Eigen::VectorXd series(40);
  for (int k = 0; k < 40; ++k) {
    series[k] = -0.1 * scatter(static_cast<std::size_t>(k));
    rows.push_back(
        {1.0 * k, k + 1.0, 10,
         moved(separate_sums(0.5, std::exp(-series[k]) * any_tensor(), any_tensor()), k)});
  }
  const auto result = fit_rule(read({stress_table(rows)}), {}, {});
  const auto expected = synthetic::mean_over_windows(series, {40});
  EXPECT_NEAR(result.value.minus_ln_s, expected.value, 1e-14);
  EXPECT_NEAR(result.high.minus_ln_s, expected.estimate().high, 1e-8);
}

TEST(Intervals, HoldEachEstimateAndExistForAll)
{
  const auto data = neutral_data(0.1);
  const auto result = fit_rule(data, parse_rule("uniform:0.8"), {});
  for (const auto& [name, place] : estimator_columns) {
    EXPECT_LT(result.low.*place, result.value.*place) << name;
    EXPECT_GT(result.high.*place, result.value.*place) << name;
  }
  EXPECT_LT(result.minus_size.estimate().low, result.minus_size.value);
  // Both rules have the noise of the same windows: their difference is known better than either value.
  EXPECT_LT(result.minus_size.estimate().high - result.minus_size.estimate().low,
            result.high.B - result.low.B);
}

TEST(Intervals, OfThePapersBIsThatOfItsSlope)
{
  const auto data = neutral_data(0.1);
  const auto result = fit_rule(data, {}, {});
  // dB/ds = -(1 + 1/s^2)/2, so the two intervals agree except for curvature.
  const double s = result.value.paper_s;
  EXPECT_NEAR((result.high.paper_B - result.low.paper_B) /
                  ((result.high.paper_s - result.low.paper_s) * (1 + 1 / (s * s)) / 2),
              1, 0.01);
}

}  // namespace
}  // namespace grseg
