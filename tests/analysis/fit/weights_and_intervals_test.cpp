// SPDX-License-Identifier: GPL-3.0-or-later
// Weights, filters and intervals of fits whose answer is worked out on paper.
#include "analysis/fit/estimators.hpp"
#include "analysis/fit/fit_pairs.hpp"
#include "analysis/fit/flows.hpp"
#include "tests/analysis/correlated_windows.hpp"
#include "tests/analysis/synthetic_fits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <vector>

namespace grseg {
namespace {

using synthetic::any_tensor;
using synthetic::moved;
using synthetic::neutral_sums;
using synthetic::read;
using synthetic::separate_sums;
using synthetic::stress_table;
using synthetic::TableRow;

/// +1 or -1: 40 windows, ordered so that correlations of neighbours cancel to a few per cent.
double sign(int window)
{
  constexpr std::string_view order = "+-++---+-+--+++-";
  return order[static_cast<std::size_t>(window) % 16] == '+' ? 1 : -1;
}

double half_width(const Estimate& interval)
{
  return (interval.high - interval.low) / 2;
}

// Neutral contacts of r = 2 at phi_L = 0.2: mixed contacts carry m = 3 phi_L phi_S/(phi_L + 2 phi_S) =
// 4/15 of the stress, so dB/dp = m/(phi_L phi_S) = 5/3. If additional contacts between large grains
// carry a small part e of the total stress, dB/dp is smaller by 5/3 e, psi_L larger by (1 - psi_L) e,
// and p* smaller by this over m, 3 e.
TEST(IntervalByHand, TheSlopeOfBFallsWhereOtherContactsGrow)
{
  std::vector<TableRow> rows;
  for (int k = 0; k < 40; ++k) {
    auto sums = neutral_sums(0.2, 2);
    sums.of(OwnSum::inside, 1) *= 1 + 0.001 * sign(k);
    rows.push_back({1.0 * k, k + 1.0, 10, sums});
  }
  const auto data = read({stress_table(rows)});
  const auto scan = scan_partition(data, parse_scan("0.6:0.7:0.1"), {});
  EXPECT_NEAR(scan.line.dB_dp.value, 5. / 3, 1e-4);
  EXPECT_NEAR(half_width(scan.line.dB_dp.estimate()) / half_width(scan.line.p_zero.estimate()),
              1. / 3 * 5. / 3, 1e-3);
}

// Four runs of this kind; in each run sigma^L is larger or smaller throughout.
TEST(IntervalByHand, TheSlopeOfBOverRunsIsThatOfEachRun)
{
  std::vector<Table> tables;
  for (int run = 0; run < 4; ++run) {
    std::vector<TableRow> rows;
    for (int k = 0; k < 10; ++k) {
      auto sums = neutral_sums(0.2, 2);
      sums.of(OwnSum::inside, 1) *= 1 + 0.001 * (run % 2 == 0 ? 1 : -1) + 1e-6 * run;
      rows.push_back({1.0 * k, k + 1.0, 10, sums});
    }
    tables.push_back(stress_table(rows));
  }
  const auto data = read(tables);
  const auto scan = scan_partition(data, parse_scan("0.6:0.7:0.1"), {});
  EXPECT_NEAR(half_width(scan.line.dB_dp.estimate()) / half_width(scan.line.p_zero.estimate()),
              1. / 3 * 5. / 3, 2e-3);
}

// Four runs of one flow and one run of another. The first four contribute 3, 1, -1 and -3 (mean 0):
// 4/3 of 20. For the single run only the noise of its twelve windows counts, not its value.
TEST(IntervalByHand, RunsOfAFlowCountByTheirScatterAndASingleOneByTheNoiseOfItsWindows)
{
  FitData data;
  data.runs = {1, 1, 1, 1, 12};
  data.flows = {0, 0, 0, 0, 1};
  Eigen::VectorXd sums = Eigen::VectorXd::LinSpaced(16, 100, 200), noise = sums;
  sums.head(4) << 3, 1, -1, -3;
  for (Eigen::Index k = 0; k < 12; ++k) noise[4 + k] = k / 3 % 2 == 0 ? 1 : -1;
  const auto error = Errors(data, Eigen::VectorXd::Ones(16)).over(Population::flows, {sums, noise});
  const double of_windows =
      deviation_of_windows(noise.tail(12), Eigen::VectorXd::Ones(12), {12}).error().error;
  EXPECT_NEAR(error.error, std::hypot(std::sqrt(4. / 3 * 20), of_windows), 1e-12);
}

TEST(WeightByHand, TheOverallCompositionOfARunIsThatOfItsFrames)
{
  std::vector<Table> tables{
      stress_table({{0, 1, 30, neutral_sums(0.2, 2)}, {1, 2, 10, neutral_sums(0.6, 2)}})};
  auto read_tables = read_fit_tables(tables, Quantity::contact, {{}});
  EXPECT_NEAR(find_flows(read_tables, "auto")[0].phi_large(), 0.3, 1e-12);
}

// While a layer becomes richer in large grains, (psi_L - phi_L)/(phi_L phi_S) grows with phi_L; at the
// share 0.65 from below 0 to above. This trend follows from the composition: it is noise neither of
// the zero nor of B over all windows.
TEST(IntervalByHand, WhatFollowsFromTheCompositionIsNotNoise)
{
  const auto phi_at = [](int k) { return 0.3 + 0.4 * k / 47; };
  double weight = 0, moment = 0;
  for (int k = 0; k < 48; ++k) {
    const double phi = phi_at(k);
    weight += phi * (1 - phi);
    moment += phi * phi * (1 - phi);
  }
  std::vector<TableRow> rows;
  for (int k = 0; k < 48; ++k) {
    const double phi = phi_at(k), mixed = 0.1;
    const double large = phi + 0.1 * phi * (1 - phi) * (phi - moment / weight);
    auto sums = separate_sums(phi, (1 - large - 0.35 * mixed) * any_tensor(),
                              (large - 0.65 * mixed) * any_tensor());
    sums.of(PairSum::whole, 0) = mixed * any_tensor();
    rows.push_back({1.0 * k, k + 1.0, 10, sums});
  }
  const auto data = read({stress_table(rows)});
  const auto scan = scan_partition(data, parse_scan("0.4:0.9:0.1"), {});
  EXPECT_NEAR(scan.line.p_zero.value, 0.65, 1e-9);
  EXPECT_LT(half_width(scan.line.p_zero.estimate()), 1e-9);
  const auto fit = fit_rule(data, {PartitionRule::Kind::uniform, 0.65}, {});
  EXPECT_LT(fit.high.B - fit.low.B, 1e-9);
}

// Layers with one composition and one number of frames: B is the mean of (psi_L - 0.2)/0.16 +- d.
TEST(IntervalByHand, OfBWhereAllLayersAreAlikeIsThatOfAMean)
{
  std::vector<TableRow> rows;
  Eigen::VectorXd series(40);
  for (int k = 0; k < 40; ++k) {
    const double large = 0.25 + 0.01 * sign(k);
    series[k] = (large - 0.2) / 0.16;
    rows.push_back(
        {1.0 * k, k + 1.0, 10,
         moved(separate_sums(0.2, (1 - large) * any_tensor(), large * any_tensor()), k)});
  }
  const auto fit = fit_rule(read({stress_table(rows)}), {}, {});
  EXPECT_NEAR(fit.value.B, 0.05 / 0.16, 1e-12);
  EXPECT_NEAR(fit.high.B, synthetic::mean_over_windows(series, {40}).estimate().high, 1e-8);
  EXPECT_NEAR(fit.at(Population::windows).low, fit.low.B, 1e-14);
}

ContactSums<2> with_contents(double small, double large, double volume)
{
  auto sums = separate_sums(0.5, any_tensor(), any_tensor());
  sums.volume = volume;
  sums.content = {small, large};
  return sums;
}

TEST(FilterByHand, CompositionsAtBothEndsOfTheRangeAreUsed)
{
  const auto data = read({stress_table({{0, 1, 9, with_contents(100, 1, 200)},
                                        {0, 1, 9, with_contents(1, 100, 200)},
                                        {0, 1, 9, with_contents(101, 1, 200)}})});
  EXPECT_EQ(data.count.used, 2u);
  EXPECT_EQ(data.count.outside_ratio, 1u);
}

// Most layers of a tall cell are empty; the reference is the solid fraction of the bed alone.
TEST(FilterByHand, ThinLayersAreLeftOutHoweverManyAreEmpty)
{
  std::vector<TableRow> rows(3, {0, 1, 9, with_contents(4, 4, 10)});
  rows.push_back({0, 1, 9, with_contents(1.5, 1.5, 10)});
  ContactSums<2> nothing;
  nothing.volume = 10;
  for (int k = 0; k < 9; ++k) rows.push_back({0, 1, 9, nothing});
  const auto data = read({stress_table(rows)});
  EXPECT_EQ(data.count.used, 3u);
  EXPECT_EQ(data.count.below_solid, 1u);
}

// Three species of sizes 1, 2 and 4 whose stresses over phi are as 1 : e^0.1 : e^0.4. The size exponent
// is the slope of the least-squares line through the origin of b = 0.1, 0.4 and 0.3 over ln 2, ln 4 and
// ln 2, with weights 4, 1 and 1.
TEST(WeightByHand, TheSizeExponentIsALineThroughTheOriginOverTheLogarithmOfSizes)
{
  FitData data;
  data.runs = {1};
  data.tables = {"sums.tsv"};
  data.species = {{"a", 1}, {"b", 2}, {"c", 4}};
  ContactSums<3> sums(3);
  sums.volume = 1;
  for (std::size_t k = 0; k < 3; ++k)
    sums.of(OwnSum::inside, k)(1, 1) = std::exp(std::vector{0.0, 0.1, 0.4}[k]);
  data.rows = {sums};
  data.samples = {{.phi_large = 0.5, .weight = 4, .size_ratio = 2, .pair = {0, 1}},
                  {.phi_large = 0.5, .weight = 1, .size_ratio = 4, .pair = {0, 2}},
                  {.phi_large = 0.5, .weight = 1, .size_ratio = 2, .pair = {1, 2}}};
  const double unit = std::log(2.);
  const double above = 4 * 0.1 * unit + 0.4 * 2 * unit + 0.3 * unit;
  const double below = 4 * unit * unit + 4 * unit * unit + unit * unit;
  EXPECT_NEAR(size_exponent(data, {}, {}).value, above / below, 1e-13);
}

}  // namespace
}  // namespace grseg
