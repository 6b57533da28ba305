// SPDX-License-Identifier: GPL-3.0-or-later
// Intervals of the closure's coefficients, from fluxes with noise (closure: docs/equations.md).
#include "tests/analysis/correlated_windows.hpp"
#include "tests/analysis/segregation/closure_bed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {
namespace {

/// Points of runs whose flux scatters by `kick` times its size; neighbouring windows are correlated
/// with rho. `steady`: the gradient is proportional to the driving force up to one per cent.
ClosureData noisy(const RunLengths& runs, double kick, synthetic::Ar1& noise, bool steady = false,
                  double run_scatter = 0)
{
  ClosureData data;
  data.runs = runs;
  data.has_kinetic = false;
  for (int n = 1; n < 9; ++n) {
    const Eigen::VectorXd normal = noise.series(runs, run_scatter);
    std::size_t window = 0;
    for (const auto length : runs)
      for (std::size_t k = 0; k < length; ++k, ++window) {
        const double progress = static_cast<double>(k) / static_cast<double>(length - 1);
        const double before = progress - 1 / static_cast<double>(length - 1);
        const auto driving = [&](double at) {
          return phi_of(n, at) * (1 - phi_of(n, at)) * weight_of_mass;
        };
        const auto gradient = [&](double at) {
          return steady ? (1 + 0.01 * std::sin(60 * at + n)) * b_over_c / d_over_c * driving(at)
                        : gradient_of(at);
        };
        const double phi = phi_of(n, progress);
        ClosurePoint point;
        point.window = window;
        point.frames = point.weight = 1;
        point.driving = driving(progress);
        point.gradient = gradient(progress);
        point.driving_before = driving(before);
        point.gradient_before = gradient(before);
        point.flux =
            b_over_c * point.driving - d_over_c * point.gradient +
            kick * b_over_c * weight_of_mass / 4 * normal[static_cast<Eigen::Index>(window)];
        point.phi_large = phi;
        point.product = phi * (1 - phi);
        point.excess = {0.04 * point.product, -0.5 * point.product, 0.3 * point.product};
        data.points.push_back(point);
      }
  }
  return data;
}

/// How often of `trials` the intervals contain the truth, and the distance of the mean from it in
/// units of its standard error.
struct Trials {
  int held_b = 0, held_d = 0;
  double bias_b = 0, bias_d = 0;
};
Trials tried(int trials, const std::function<ClosureData(synthetic::Ar1&)>& make, double rho = 0)
{
  synthetic::Ar1 noise(rho, 11);
  Trials all;
  double sum[2] = {}, squares[2] = {};
  for (int trial = 0; trial < trials; ++trial) {
    const auto summary = closure_summary(make(noise), parse_rules({"size"}));
    const auto b = number_of(summary, "B_over_c[s]"), d = number_of(summary, "d_over_c[m^2/s]");
    all.held_b += b.low <= b_over_c && b_over_c <= b.high ? 1 : 0;
    all.held_d += d.low <= d_over_c && d_over_c <= d.high ? 1 : 0;
    for (const auto& [k, error] : {std::pair{0, b.value - b_over_c}, {1, d.value - d_over_c}}) {
      sum[k] += error;
      squares[k] += error * error;
    }
  }
  all.bias_b = sum[0] / std::sqrt(squares[0]);
  all.bias_d = sum[1] / std::sqrt(squares[1]);
  return all;
}

// Expected count: from `least` to 95 of 100, with a tolerance of three standard deviations of such
// a count. The mean of many trials may be off by three of its standard errors.
void expect_coverage(const Trials& trials, int count, double least = 0.95)
{
  for (const int held : {trials.held_b, trials.held_d}) {
    EXPECT_GE(held, least * count - 3 * std::sqrt(least * (1 - least) * count));
    EXPECT_LE(held, 0.95 * count + 3 * std::sqrt(0.95 * 0.05 * count));
  }
  EXPECT_LT(std::abs(trials.bias_b), 3);
  EXPECT_LT(std::abs(trials.bias_d), 3);
}

TEST(SegregationClosure, IntervalsOfOneRunHoldTheTruth)
{
  expect_coverage(tried(400, [](auto& noise) { return noisy({60}, 0.5, noise); }), 400);
}

// With a correlation of 0.5 between neighbours, intervals from 120 windows contain the truth in 93 of
// 100 cases if the weight of a window changes along the run, as that of the gradient does.
TEST(SegregationClosure, IntervalsOfOneRunHoldTheTruthWhereWindowsAreCorrelated)
{
  const auto make = [](auto& noise) { return noisy({120}, 0.5, noise); };
  expect_coverage(tried(400, make, 0.5), 400, 0.93);
}

TEST(SegregationClosure, IntervalsOfSeveralRunsHoldTheTruthAlsoWhereRunsDiffer)
{
  const RunLengths six(6, 30);
  expect_coverage(tried(400, [&](auto& noise) { return noisy(six, 0.5, noise); }), 400);
  expect_coverage(tried(400, [&](auto& noise) { return noisy(six, 0.5, noise, false, 0.5); }), 400);
}

double width_of(const NamedNumbers& summary, const std::string& name)
{
  const auto estimate = number_of(summary, name);
  return estimate.high - estimate.low;
}

// If B has no noise, the relative error of c = B/(B/c) equals that of B/c. An error of psi that is
// equal under all rules moves p* by this error over B(1) - B(0) = 0.8.
TEST(SegregationClosure, IntervalsOfCAndPStarFollowFromThoseOfWhatTheyAreMadeOf)
{
  synthetic::Ar1 noise(0);
  auto data = noisy({60}, 0.1, noise);
  const auto sure = closure_summary(data, parse_rules({"size"}));
  const double of_c = width_of(sure, "c@size[1/s]") / number_of(sure, "c@size[1/s]").value;
  const double of_b = width_of(sure, "B_over_c[s]") / number_of(sure, "B_over_c[s]").value;
  EXPECT_NEAR(of_c, of_b, 0.1 * of_b);  // blocks may be longer by one
  EXPECT_NEAR(number_of(sure, "p_zero").value, 0.5 / 0.8, 1e-12);
  EXPECT_NEAR(width_of(sure, "p_zero"), 0, 1e-12);
  EXPECT_NEAR(number_of(sure, "dc_dp[1/s]").value, 0.8 / number_of(sure, "B_over_c[s]").value,
              1e-7);

  for (auto& point : data.points) {
    const double off = 0.01 * noise.normal() * point.product;
    for (auto& excess : point.excess) excess += off;
  }
  const auto off = closure_summary(data, parse_rules({"size"}));
  EXPECT_GT(width_of(off, "B@size"), 1e-4);
  EXPECT_NEAR(width_of(off, "p_zero"), width_of(off, "B@size") / 0.8, 1e-10);
}

// Contacts that are shared between layers change the total stress of a layer with the share p. With
// the ratio r of totals, psi_L is ((1 - p) psi(0) + p r psi(1))/(1 - p + p r).
TEST(SegregationClosure, PStarIsTheZeroOfBAlsoWhereTheShareChangesTheStressOfALayer)
{
  synthetic::Ar1 noise(0);
  auto data = noisy({60}, 0.1, noise);
  for (auto& point : data.points) point.total_ratio = 1.2;
  const auto same = closure_summary(data, parse_rules({"size"}));
  const double zero = 0.5 / (0.5 + 1.2 * 0.3), total = 1 + 0.2 * zero;
  EXPECT_NEAR(number_of(same, "p_zero").value, zero, 1e-12);
  EXPECT_NEAR(
      number_of(same, "dc_dp[1/s]").value * number_of(same, "B_over_c[s]").value * total * total,
      1.2 * 0.8, 1e-12);

  for (std::size_t k = 0; k < data.points.size(); k += 2) data.points[k].total_ratio = 0.7;
  const double share = number_of(closure_summary(data, parse_rules({"size"})), "p_zero").value;
  double excess = 0, product = 0;
  for (const auto& point : data.points) {
    excess += point.excess_at(share);
    product += point.product;
  }
  EXPECT_NEAR(excess / product, 0, 1e-14);
  EXPECT_GT(std::abs(share - 0.5 / 0.8), 1e-3);
}

// The factor is one over the sine of the angle between the regressors.
TEST(SegregationClosure, CollinearRegressorsAreReportedWithWhatTheyMakeOfTheError)
{
  synthetic::Ar1 noise(0);
  const auto apart = closure_summary(noisy({60}, 0.1, noise), two_rules);
  EXPECT_LT(std::abs(number_of(apart, "regressor_correlation").value), 0.3);
  EXPECT_LT(number_of(apart, "error_factor").value, 1.05);
  EXPECT_FALSE(remarks_hold(apart, "collinear"));

  auto data = noisy({60}, 0.1, noise, true);
  EXPECT_GT(number_of(closure_summary(data, two_rules), "error_factor").value, 100);
  data.instruments = Instruments::same;
  const auto steady = closure_summary(data, two_rules);
  const double r = number_of(steady, "regressor_correlation").value;
  EXPECT_GT(r, 0.9999);
  EXPECT_NEAR(number_of(steady, "error_factor").value, 1 / std::sqrt(1 - r * r), 1e-6);
  EXPECT_NEAR(number_of(steady, "condition_number").value, std::sqrt((1 + r) / (1 - r)), 1e-6);
  EXPECT_GT(number_of(steady, "estimate_correlation").value, 0.99);
  EXPECT_TRUE(remarks_hold(steady, "collinear over these rows"));
  EXPECT_GT(width_of(steady, "B_over_c[s]"), 20 * width_of(apart, "B_over_c[s]"));
}

/// A bed whose composition is moved by a flux of the closure plus noise of this flux, as in a run: the
/// noise of a window changes the gradient of the same window.
ClosureData moved_by_its_flux(synthetic::Ar1& noise, Instruments instruments)
{
  constexpr int layers = 14, windows = 60, steps = 25;
  constexpr double dt = 0.05, kick = 2e-3;  // time step, s; noise in one step, m/s
  std::vector<double> phi(layers);
  for (int n = 0; n < layers; ++n) phi[static_cast<std::size_t>(n)] = n < 7 ? 0.55 : 0.25;
  const auto driving = [](double at) { return at * (1 - at) * weight_of_mass; };
  ClosureData data;
  data.instruments = instruments;
  data.has_kinetic = false;
  data.runs = {windows - 1};
  std::vector<double> before;
  for (int window = 0; window < windows; ++window) {
    std::vector<double> mean(layers), flux(layers);
    for (int step = 0; step < steps; ++step) {
      std::vector<double> face(layers + 1);  // flux through the bottom of each layer
      for (std::size_t n = 1; n < layers; ++n)
        face[n] = b_over_c * driving((phi[n] + phi[n - 1]) / 2) -
                  d_over_c * (phi[n] - phi[n - 1]) / layer + kick * noise.normal();
      for (std::size_t n = 0; n < layers; ++n) {
        mean[n] += phi[n] / steps;
        flux[n] += (face[n] + face[n + 1]) / 2 / steps;
        phi[n] = std::clamp(phi[n] - dt / layer * (face[n + 1] - face[n]), 0.01, 0.99);
      }
    }
    const auto gradient = [](const std::vector<double>& of, std::size_t n) {
      return (of[n + 1] - of[n - 1]) / (2 * layer);
    };
    for (std::size_t n = 2; window > 0 && n + 2 < layers; ++n) {
      ClosurePoint point;
      point.window = static_cast<std::size_t>(window - 1);
      point.frames = point.weight = 1;
      point.flux = flux[n];
      point.driving = driving(mean[n]);
      point.gradient = gradient(mean, n);
      point.driving_before = driving(before[n]);
      point.gradient_before = gradient(before, n);
      point.phi_large = mean[n];
      point.product = mean[n] * (1 - mean[n]);
      point.excess = {0.04 * point.product, -0.5 * point.product, 0.3 * point.product};
      data.points.push_back(point);
    }
    before = mean;
  }
  return data;
}

// Large grains that rise by chance increase the gradient of their own window.
TEST(SegregationClosure, TheFluxsOwnNoiseBiasesLeastSquaresAndNotTheWindowBefore)
{
  const auto previous =
      tried(100, [](auto& noise) { return moved_by_its_flux(noise, Instruments::previous); });
  EXPECT_LT(std::abs(previous.bias_b), 3);
  EXPECT_LT(std::abs(previous.bias_d), 3);
  const auto same =
      tried(100, [](auto& noise) { return moved_by_its_flux(noise, Instruments::same); });
  EXPECT_LT(same.bias_d, -5);
}

TEST(SegregationClosure, RegressorsThatAreTheSameUpToAFactorGiveNoNumber)
{
  synthetic::Ar1 noise(0);
  auto data = noisy({20}, 0.1, noise);
  for (auto& point : data.points) point.gradient = 2 * point.driving;
  const auto summary = closure_summary(data, two_rules);
  EXPECT_TRUE(std::isnan(number_of(summary, "B_over_c[s]").value));
  EXPECT_TRUE(remarks_hold(summary, "cannot be told apart"));
}

/// Two runs of each of two mixtures whose B/c are 1/2 and 3/2 of the mean.
ClosureData two_mixtures()
{
  synthetic::Ar1 noise(0, 5);
  auto data = noisy({30, 30, 30, 30}, 0.01, noise);
  for (auto& point : data.points)
    point.flux += (point.window < 60 ? -0.5 : 0.5) * b_over_c * point.driving;
  return data;
}

// Drawn as one population, the four values, two lower and two higher by half of B/c, have the standard error
// B/c/2 sqrt(1/3), and Student's quantile of three degrees of freedom is 3.182. The result says that it did
// so.
TEST(SegregationClosure, RunsAreOnePopulationWhateverTheirMixtures)
{
  const auto summary = closure_summary(two_mixtures(), parse_rules({"size"}));
  const double expected = 2 * 3.182 * b_over_c / 2 * std::sqrt(1. / 3);
  EXPECT_NEAR(width_of(summary, "B_over_c[s]") / expected, 1, 0.1);
  EXPECT_NE(closure_population(4).find("how they differ counts as scatter of runs"),
            std::string::npos);
  EXPECT_TRUE(closure_population(1).starts_with("windows: this very run"));
}

TEST(ClosureIntervals, ANumberThatFollowsTheFluxHasTheErrorsOfItsCoefficients)
{
  synthetic::Ar1 noise(0, 3);
  const auto data = noisy({40, 40, 40, 40}, 0.3, noise);
  const auto summary = closure_summary(data, two_rules);
  const auto b = number_of(summary, "B_over_c[s]"), d = number_of(summary, "d_over_c[m^2/s]");
  const auto half = [](const Estimate& estimate) { return (estimate.high - estimate.low) / 2; };
  const auto of_b = estimate_from_flux(data, 7, {2, 0});
  EXPECT_EQ(of_b.value, 7);
  EXPECT_NEAR(half(of_b) / half(b), 2, 1e-9);
  EXPECT_NEAR(half(estimate_from_flux(data, 7, {0, 2})) / half(d), 2, 1e-9);
  // Both grow together here (estimate_correlation), so that errors of their sum add up.
  EXPECT_GT(number_of(summary, "estimate_correlation").value, 0);
  EXPECT_GT(half(estimate_from_flux(data, 7, {1 / half(b), 1 / half(d)})), std::sqrt(2));
}

}  // namespace
}  // namespace grseg
