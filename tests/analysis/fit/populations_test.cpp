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
  Held windows, runs, flows;
  for (unsigned long trial = 1; trial <= 300; ++trial) {
    const auto [data, truth] = source.draw();
    const auto fits = fit_flows(data, {}, {});
    const auto& all = fits.all;
    windows.add(all.at(Population::windows), truth.of_runs);
    flows.add(all.at(Population::flows), truth.of_flows);
    for (std::size_t m = 0; m < fits.of_each.size(); ++m)
      runs.add(fits.of_each[m].at(Population::runs), truth.of_each[m]);
  }
  windows.expect_95_percent("windows");
  runs.expect_95_percent("runs");
  flows.expect_95_percent("flows");
}

TEST(Coverage, OfTwoRunsOfEachFlowIsThatOfMore)
{
  synthetic::RunsOfFlows source({6, 2, 0, 0});
  Held flows;
  for (unsigned long trial = 1; trial <= 300; ++trial) {
    const auto [data, truth] = source.draw();
    const auto all = fit_flows(data, {}, {}).all;
    flows.add(all.at(Population::flows), truth.of_flows);
  }
  flows.expect_95_percent("flows");
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

TEST(Populations, EachIsNamedInWordsWithItsWeights)
{
  EXPECT_NE(estimand_words(Population::flows, 6)
                .find("these 6 flows, weighted as they are (by frames x phi_L phi_S)"),
            std::string::npos);
  for (const auto& [word, over, meaning] : populations)
    EXPECT_GT(estimand_words(over, 2).size(), 40u) << word;
}

}  // namespace
}  // namespace grseg
