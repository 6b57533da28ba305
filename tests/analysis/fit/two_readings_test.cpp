// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/two_readings.hpp"

#include "analysis/fit/flows.hpp"
#include "formats/core/errors.hpp"
#include "tests/analysis/synthetic_fits.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace grseg {
namespace {

using synthetic::scatter;

constexpr int windows = 60;

/// A reading of a run in which large grains bear the share phi_L (1 + B phi_S), B by window.
Table reading(const std::function<double(int)>& b, int from = 0)
{
  std::vector<synthetic::TableRow> rows;
  for (int w = from; w < windows; ++w)
    for (const double phi : synthetic::compositions) {
      const double psi = phi * (1 + b(w) * (1 - phi));
      rows.push_back({1.25 * w, 1.25 * (w + 1), 25,
                      synthetic::separate_sums(phi, (1 - psi) * Tensor2::Identity(),
                                               psi * Tensor2::Identity())});
    }
  return synthetic::stress_table(rows);
}

double noise(int window, int seed)
{
  return 0.02 * scatter(static_cast<std::size_t>(1000 * seed + window));
}

RuleFit difference(const std::vector<Table>& tables, const std::vector<Table>& others)
{
  const auto source = [](const std::vector<Table>& all) {
    FitSource of{synthetic::read_all(all), Quantity::contact, {}};
    find_flows(of.tables, "auto");
    return of;
  };
  const auto one = source(tables);
  auto fits = fit_pairs(one.tables, one.quantity, one.filters, {{0, 1}}, {{}}, {}, false);
  add_differences(fits, one, source(others), {});
  return fits.back();
}

double width(const Estimate& estimate)
{
  return estimate.high - estimate.low;
}

TEST(TwoReadings, NoiseThatBothShareIsNotInTheirDifference)
{
  const auto fit = difference({reading([](int w) { return 0.04 + noise(w, 1); })},
                              {reading([](int w) { return 0.01 + noise(w, 1); })});
  const auto minus = fit.minus_other.estimate();
  EXPECT_NEAR(minus.value, 0.03, 1e-13);
  EXPECT_GT(width(fit.estimate(&Estimators::B)), 0.003);
  EXPECT_LT(width(minus), 1e-12);
}

TEST(TwoReadings, NoiseThatOnlyOneHasIsAllInTheirDifference)
{
  const auto fit = difference({reading([](int w) { return 0.04 + noise(w, 1); })},
                              {reading([](int w) { return 0.01 + 1e-2 * noise(w, 3); })});
  const auto minus = fit.minus_other.estimate(), b = fit.estimate(&Estimators::B);
  EXPECT_NEAR(minus.value, fit.value.B - 0.01, 2e-4);
  EXPECT_NEAR(width(minus) / width(b), 1, 0.01);
}

TEST(TwoReadings, OverRunsTheDifferenceHasTheScatterOfTheRunsDifferences)
{
  // The two runs differ by 0.2 in B, and by 0.002 in the difference of the readings.
  const auto run = [](double b, int seed) {
    return reading([=](int w) { return b + noise(w, seed); });
  };
  const auto fit = difference({run(0.1, 1), run(0.3, 2)}, {run(0.05, 1), run(0.252, 2)});
  EXPECT_EQ(fit.over, Population::runs);
  EXPECT_NEAR(fit.minus_other.value, 0.049, 1e-4);
  EXPECT_NEAR(fit.minus_other.error.error / fit.error.B, 0.01, 1e-3);
}

TEST(TwoReadings, WindowsOfOneReadingAloneDoNotCount)
{
  // The other reading lacks ten windows, in which this one has another B.
  const auto fit = difference({reading([](int w) { return (w < 10 ? 0.5 : 0.04) + noise(w, 1); })},
                              {reading([](int w) { return 0.01 + noise(w, 1); }, 10)});
  EXPECT_NEAR(fit.minus_other.value, 0.03, 1e-13);
}

TEST(TwoReadings, ReadingsWithoutACommonWindowAreRefused)
{
  const auto b = [](int w) { return noise(w, 1); };
  auto later = reading(b);
  for (auto& row : later.rows) row[0] += 0.1, row[1] += 0.1;
  EXPECT_THROW(difference({reading(b)}, {later}), UsageError);
}

TEST(TwoReadings, OtherRunsAreRefused)
{
  auto one = reading([](int) { return 0; }), other = one;
  one.header.emplace_back("input", "xxh3 1");
  other.header.emplace_back("input", "xxh3 2");
  EXPECT_NO_THROW(require_same_runs({one}, {one}));
  EXPECT_THROW(require_same_runs({one}, {other}), UsageError);
  EXPECT_THROW(require_same_runs({one}, {one, one}), UsageError);
}

}  // namespace
}  // namespace grseg
