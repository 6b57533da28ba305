// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/estimators.hpp"
#include "analysis/fit/fit_pairs.hpp"
#include "analysis/fit/flows.hpp"
#include "tests/analysis/correlated_windows.hpp"
#include "tests/analysis/synthetic_fits.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace grseg {
namespace {

using synthetic::read_all;
using synthetic::run_of;

/// Runs of one window and one layer. -ln s of the three runs is the value of the flow plus -d, 0 and d.
struct KnownFlow {
  double b, d, weight;
};
FitData three_runs_of_each(const std::vector<KnownFlow>& flows)
{
  FitData data;
  data.quantity = Quantity::kinetic;
  data.tables = {"runs.tsv"};
  for (std::size_t flow = 0; flow < flows.size(); ++flow)
    for (const double step : {-1, 0, 1}) {
      const auto& known = flows[flow];
      const double slope = std::exp(-known.b - step * known.d);
      ContactSums<3> sums;
      sums.volume = 1;
      sums.of(OwnSum::inside, 0)(1, 1) = slope;
      sums.of(OwnSum::inside, 1)(1, 1) = 1;
      data.samples.push_back({.window = data.runs.size(),
                              .phi_large = 0.5,
                              .weight = known.weight,
                              .frames = known.weight,
                              .size_ratio = 2,
                              .row = data.rows.size()});
      data.rows.push_back(sums);
      data.runs.push_back(1);
      data.flows.push_back(flow);
    }
  return data;
}

RuleFit fit_over(const FitData& data, Population over)
{
  return fit_flows(data, {}, {.over = over}).all;
}

double reach(const RuleFit& fit)
{
  return (fit.high.minus_ln_s - fit.low.minus_ln_s) / 2;
}

// Three runs at -d, 0 and d about their flow: the standard error of its mean is d/sqrt(3), with two
// degrees of freedom. minus_ln_s = -ln s is linear in the runs.
TEST(Populations, IntervalsOfOneFlowAreOverItsRuns)
{
  const auto fit = fit_over(three_runs_of_each({{0.04, 0.003, 2}}), Population::automatic);
  EXPECT_EQ(fit.over, Population::runs);
  EXPECT_NEAR(fit.value.minus_ln_s, 0.04, 1e-15);
  EXPECT_NEAR(reach(fit), gsl_cdf_tdist_Pinv(0.975, 2) * 0.003 / std::sqrt(3), 1e-10);
  EXPECT_NEAR(fit.degrees, 2, 1e-12);
  EXPECT_NEAR(fit.at(Population::runs).low, fit.low.B, 1e-15);
}

TEST(Populations, FlowsAsTheyAreCountByTheirWeights)
{
  const auto fit =
      fit_over(three_runs_of_each({{0.03, 0.003, 1}, {0.05, 0.001, 3}}), Population::automatic);
  EXPECT_EQ(fit.over, Population::flows);
  EXPECT_NEAR(fit.value.minus_ln_s, (0.03 + 3 * 0.05) / 4, 1e-15);
  // Both flows contribute equal errors: 0.003/4 and 3 x 0.001/4, over sqrt(3).
  const double error = std::sqrt(2.0 / 3) * 0.003 / 4;
  EXPECT_NEAR(reach(fit), gsl_cdf_tdist_Pinv(0.975, 4) * error, 1e-10);
}

TEST(Populations, EqualFlowsAreTheMeanOfTheirBs)
{
  const auto data = three_runs_of_each({{0.03, 0.003, 1}, {0.05, 0.001, 3}, {0.07, 0.002, 9}});
  const auto fit = fit_over(data, Population::equal_flows);
  EXPECT_NEAR(fit.value.minus_ln_s, 0.05, 1e-15);
  // Squares of 0.003, 0.001 and 0.002 over 27, with two degrees of freedom each.
  const double sum = 14e-6, fourths = (81e-12 + 1e-12 + 16e-12) / (2 + 2);
  const double degrees = sum * sum / fourths - 2;
  EXPECT_NEAR(reach(fit), gsl_cdf_tdist_Pinv(0.975, degrees) * std::sqrt(sum / 27), 1e-10);
  EXPECT_NEAR(fit.degrees, degrees, 0.01);  // degrees of B, which is not quite linear
  // Differences between flows are not part of the interval.
  const auto apart = three_runs_of_each({{-0.53, 0.003, 1}, {0.05, 0.001, 3}, {0.63, 0.002, 9}});
  EXPECT_NEAR(reach(fit_over(apart, Population::equal_flows)), reach(fit), 1e-10);
}

/// Two flows of two runs each that scatter by `scatter`; large grains are twice as large as small ones.
FitData four_runs(double scatter)
{
  const std::vector<Table> tables{run_of(0.3, "1", scatter), run_of(0.3, "1", 2 * scatter),
                                  run_of(0.6, "1", -scatter), run_of(0.6, "1", 3 * scatter)};
  auto read = read_all(tables);
  find_flows(read, "auto");
  return select_fit_data(read, Quantity::contact, {}, {{0, 1}});
}

// Next to B is its difference from B under size: in both numbers each flow has equal weight.
TEST(Populations, AllNumbersOfARowAreOverTheSamePopulation)
{
  const auto data = four_runs(0.2);
  for (const auto over : {Population::equal_flows, Population::random_flows}) {
    const auto fits = fit_flows(data, parse_rule("half"), {.over = over});
    const auto &half = fits.all, &first = fits.of_each.at(0), &second = fits.of_each.at(1);
    const auto size = fit_over(data, over);
    EXPECT_NEAR(half.minus_size.value, half.value.B - size.value.B, 1e-14);
    EXPECT_LT(half.minus_size.estimate().low, half.minus_size.value);
    EXPECT_NEAR(half.neutral, (first.neutral + second.neutral) / 2, 1e-15);
    EXPECT_NEAR(half.share, 0.5, 1e-14);
    const auto a = size_exponent(data, parse_rule("half"), {.over = over});
    EXPECT_NEAR(a.value, half.value.minus_ln_s / std::log(2), 1e-13);
    EXPECT_NEAR(a.low, half.low.minus_ln_s / std::log(2), 1e-9 * (a.high - a.low));
    EXPECT_NEAR(half.line.dB_dp.value, (first.line.dB_dp.value + second.line.dB_dp.value) / 2,
                1e-15);
  }
}

// Errors of the difference half - size of two separately fitted flows combine: 1/2 of the root of the
// sum of their squares.
TEST(Populations, TheDifferenceToSizeHasTheErrorsOfTheFlowsDifferences)
{
  const auto fits =
      fit_flows(four_runs(0.2), parse_rule("half"), {.over = Population::equal_flows});
  const double sum = std::hypot(fits.of_each.at(0).minus_size.error.error,
                                fits.of_each.at(1).minus_size.error.error);
  EXPECT_GT(sum, 0);
  EXPECT_NEAR(fits.all.minus_size.error.error, sum / 2, 1e-15);
}

// The intervals of single flows are over their runs, whatever the intervals over all flows are over.
TEST(Populations, EqualFlowsAreOverTheirRunsAlsoBesideIntervalsOverWindows)
{
  synthetic::RunsOfFlows source({3, 4, 2, 3});
  const auto data = source.draw().data;
  const auto by_windows = fit_over(data, Population::windows),
             by_runs = fit_over(data, Population::flows);
  ASSERT_TRUE(std::isfinite(by_runs.at(Population::equal_flows).low));
  EXPECT_EQ(by_windows.at(Population::equal_flows).low, by_runs.at(Population::equal_flows).low);
  EXPECT_EQ(by_windows.at(Population::equal_flows).high, by_runs.at(Population::equal_flows).high);
}

// Student's interval of the mean of 0.03, 0.05 and 0.07.
TEST(Populations, RandomFlowsScatterLikeTheirBs)
{
  const auto data = three_runs_of_each({{0.03, 0.003, 1}, {0.05, 0.001, 3}, {0.07, 0.002, 9}});
  const auto fit = fit_over(data, Population::random_flows);
  EXPECT_NEAR(fit.value.minus_ln_s, 0.05, 1e-15);
  EXPECT_NEAR(reach(fit), gsl_cdf_tdist_Pinv(0.975, 2) * 0.02 / std::sqrt(3), 1e-12);
  EXPECT_NE(fit.doubt.find("3 flows show little of how flows differ"), std::string::npos);
  EXPECT_TRUE(std::isfinite(fit.at(Population::equal_flows).low));
  EXPECT_NEAR(fit.at(Population::flows).value, fit_over(data, Population::flows).value.B, 1e-15);
}

/// Share of trials in which an interval of B contains the true value.
struct Held {
  int trials = 0, held = 0;

  void add(const Estimate& b, double truth)
  {
    ++trials;
    held += b.low <= truth && truth <= b.high;
  }
  double share() const { return static_cast<double>(held) / trials; }
  /// Expects 95 % within 3.5 standard deviations of a binomial share of so many trials.
  void expect_95_percent(const char* what) const
  {
    EXPECT_NEAR(share(), 0.95, 3.5 * std::sqrt(0.95 * 0.05 / trials)) << "over " << what;
  }
};

// Flows differ by twice the error of one flow; runs differ as much as their windows explain.
TEST(Coverage, OfEachPopulationIsThatOfItsOwnNumberAndNotOfAnother)
{
  synthetic::RunsOfFlows source({6, 4, 2, 1});
  Held windows, runs, flows, equal, random, equal_for_all;
  for (unsigned long trial = 1; trial <= 300; ++trial) {
    const auto [data, truth] = source.draw();
    const auto fits = fit_flows(data, {}, {});
    const auto& all = fits.all;
    windows.add(all.at(Population::windows), truth.of_runs);
    flows.add(all.at(Population::flows), truth.of_flows);
    equal.add(all.at(Population::equal_flows), truth.of_equal);
    random.add(all.at(Population::random_flows), truth.of_all);
    equal_for_all.add(all.at(Population::equal_flows), truth.of_all);
    for (std::size_t m = 0; m < fits.of_each.size(); ++m)
      runs.add(fits.of_each[m].at(Population::runs), truth.of_each[m]);
  }
  windows.expect_95_percent("windows");
  runs.expect_95_percent("runs");
  flows.expect_95_percent("flows");
  equal.expect_95_percent("equal flows");
  random.expect_95_percent("random flows");
  // The mean of six flows is off by twice the error of one over sqrt(6); its own error is smaller by the
  // root of 5. Its interval contains the mean of all flows with the probability of |Z| < 2.1/sqrt(5).
  EXPECT_LT(equal_for_all.share(), 0.8);
}

TEST(Coverage, OfTwoRunsOfEachFlowIsThatOfMore)
{
  synthetic::RunsOfFlows source({6, 2, 0, 0});
  Held flows, equal;
  for (unsigned long trial = 1; trial <= 300; ++trial) {
    const auto [data, truth] = source.draw();
    const auto all = fit_flows(data, {}, {}).all;
    flows.add(all.at(Population::flows), truth.of_flows);
    equal.add(all.at(Population::equal_flows), truth.of_equal);
  }
  flows.expect_95_percent("flows");
  equal.expect_95_percent("equal flows");
}

/// Number of trials, out of `trials`, that report the doubt that one function of composition is not enough.
int doubts_of_one_function(double flow_scatter, unsigned long trials)
{
  synthetic::RunsOfFlows source({6, 4, flow_scatter, 1});
  int doubts = 0;
  for (unsigned long trial = 1; trial <= trials; ++trial) {
    const auto data = source.draw().data;
    const auto fit = fit_rule(data, {}, {.over = Population::compositions});
    doubts += fit.doubt.starts_with("flows differ by more");
  }
  return doubts;
}

// Fisher's test at 5 % has at most 5 % false alarms. If flows differ by four times the error of one, so
// that the ratio of mean squares is 17 on average, the test misses this in a few of a hundred trials.
TEST(Populations, OneFunctionOfCompositionIsDoubtedWhereFlowsDiffer)
{
  constexpr double by_chance = 0.05 * 200;
  EXPECT_LT(doubts_of_one_function(0, 200), by_chance + 3.5 * std::sqrt(by_chance * 0.95));
  EXPECT_GT(doubts_of_one_function(4, 100), 90);
}

// A single run does not show how runs differ. Its windows give an interval with a doubt.
TEST(Populations, AFlowOfOneRunHasAnIntervalOverItsWindows)
{
  synthetic::RunsOfFlows source({2, 1, 0, 0});
  const auto fits = fit_flows(source.draw().data, {}, {});
  ASSERT_EQ(fits.of_each.size(), 2u);
  EXPECT_EQ(fits.of_each[0].over, Population::windows);
  EXPECT_EQ(fits.all.over, Population::flows);
  EXPECT_TRUE(fits.all.doubt.starts_with("2 of 2 flows have one run")) << fits.all.doubt;
  EXPECT_LT(fits.all.low.B, fits.all.value.B);
}

// Windows of a single run differ among themselves by +-1. A common offset of 7, which comes from the
// flow, is not scatter, and neither is an offset in proportion to unequal weights.
TEST(Populations, ADifferenceOfItsFlowIsNoScatterOfASingleRunsWindows)
{
  FitData data;
  data.runs = {8};
  data.flows = {0};
  Eigen::VectorXd scatter(8), weight = Eigen::VectorXd::Ones(8);
  scatter << 1, -1, 1, 1, -1, -1, -1, 1;
  const auto error_of = [&](const Eigen::VectorXd& noise) {
    return Errors(data, weight).over(Population::flows, {noise, noise});
  };
  const auto alone = error_of(scatter / 8), shifted = error_of((scatter.array() + 7) / 8);
  EXPECT_GT(alone.error, 0.1);
  EXPECT_NEAR(shifted.error, alone.error, 1e-13);
  EXPECT_NEAR(shifted.degrees, alone.degrees, 1e-12);
  weight << 1, 2, 3, 4, 4, 3, 2, 1;
  EXPECT_NEAR(error_of(0.3 * weight).error, 0, 1e-15);
}

// Two runs of each of four flows. The values of flows are -3, -1, 1, 3 times `apart`, runs differ from
// them by plus and minus 1: mean squares 2 x 20 apart^2/f between flows and 8/4 within. If composition
// explains two of the three degrees of freedom, one is left, and Fisher's quantile of 5 % with 1 and 4
// degrees is 7.7086, not 6.5914.
TEST(Populations, FishersTestCountsTheDegreesThatCompositionHasTaken)
{
  FitData data;
  data.runs = RunLengths(8, 1);
  data.flows = {0, 0, 1, 1, 2, 2, 3, 3};
  const Errors errors(data, Eigen::VectorXd::Ones(8));
  const auto chance = [&](double ratio, double fitted) {
    const double apart = std::sqrt(ratio * 2 * (4 - fitted) / 40);
    Eigen::VectorXd value(8);
    for (Eigen::Index k = 0; k < 8; ++k)
      value[k] = apart * static_cast<double>(2 * (k / 2) - 3) + (k % 2 == 0 ? 1 : -1);
    return errors.chance_of_likeness(value, fitted);
  };
  EXPECT_NEAR(chance(6.5914, 1), 0.05, 1e-5);
  EXPECT_NEAR(chance(7.7086, 3), 0.05, 1e-5);
}

TEST(Populations, EachIsNamedInWordsWithItsWeights)
{
  EXPECT_NE(estimand_words(Population::flows, 6)
                .find("these 6 flows, weighted as they are (by frames x phi_L phi_S)"),
            std::string::npos);
  EXPECT_NE(estimand_words(Population::equal_flows, 6).find("each counting the same"),
            std::string::npos);
  for (const auto& [word, over, meaning] : populations)
    EXPECT_GT(estimand_words(over, 2).size(), 40u) << word;
}

}  // namespace
}  // namespace grseg
