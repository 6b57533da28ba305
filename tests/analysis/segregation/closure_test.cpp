// SPDX-License-Identifier: GPL-3.0-or-later
// What the flux of large grains fixes of Gray & Thornton's closure, and what a rule makes of it.
#include "analysis/segregation/closure.hpp"

#include "analysis/stress/neutral_contacts.hpp"
#include "formats/core/errors.hpp"
#include "tests/analysis/correlated_windows.hpp"
#include "tests/analysis/synthetic_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {
namespace {

constexpr double b_over_c = 3e-4, d_over_c = 1.3e-4;   // s, m^2/s
constexpr double weight_of_mass = 9.02, layer = 0.02;  // g cos, m/s^2; m
const std::vector<PartitionRule> two_rules = parse_rules({"uniform:0.8,half"});

Estimate number_of(const SegregationSummary& summary, const std::string& name)
{
  for (const auto& [known, estimate] : summary.numbers)
    if (known == name) return estimate;
  ADD_FAILURE() << name;
  return {};
}

bool remarks_hold(const SegregationSummary& summary, const std::string& words)
{
  return std::any_of(
      summary.remarks.begin(), summary.remarks.end(),
      [&](const std::string& remark) { return remark.find(words) != std::string::npos; });
}

/// A bed of ten layers that segregates: large grains below at first, above at the end.
double phi_of(int n, double progress)
{
  return 0.35 + 0.25 * (2 * progress - 1) * (n - 4.5) / 4.5;
}
double gradient_of(double progress)
{
  return 0.25 * (2 * progress - 1) / 4.5 / layer;
}

/// What a run is made of besides its flux.
struct Made {
  double temperature = 0, temperature_slope = 0,
         b_kinetic = 0;        // K/rho at y = 0, m^2/s^2; its d/dy
  double acceleration = 0;     // a/(phi_L phi_S), m/s^2
  double b = 0, c = 0, d = 0;  // flux of the closure with all terms; c = 0: of X and G alone
};

/// The forces per mass of a layer by their definitions, K linear in y.
struct Terms {
  double driving, push, spread, inertia;
};
Terms terms_of(const Made& made, int n, double progress)
{
  const auto share = [&](int layer_number) {
    const double phi = phi_of(layer_number, progress);
    return phi * (1 + made.b_kinetic * (1 - phi));
  };
  const auto k = [&](int layer_number) {
    return made.temperature + made.temperature_slope * layer * (layer_number + 0.5);
  };
  const double phi = phi_of(n, progress), both = phi * (1 - phi);
  const double slope = (share(n + 1) * k(n + 1) - share(n - 1) * k(n - 1)) / (2 * layer);
  return {both * (weight_of_mass + made.temperature_slope),
          -made.b_kinetic * both * made.temperature_slope,
          -(slope - share(n) * made.temperature_slope), made.acceleration * both};
}

constexpr double area = 0.007, solid = 0.8, density = 1;  // of a layer, m^2; kg/m^2

std::vector<double> motion_cells(const Made& made, int n, double progress, double kick)
{
  const double phi = phi_of(n, progress), mass = density * solid * area;
  const auto [driving, push, spread, inertia] = terms_of(made, n, progress);
  const double flux =
      made.c > 0
          ? (made.b * driving - made.d * gradient_of(progress) + push + spread - inertia) / made.c
          : b_over_c * driving - d_over_c * gradient_of(progress);
  const double k = mass * (made.temperature + made.temperature_slope * layer * (n + 0.5));
  const double share = phi * (1 + made.b_kinetic * (1 - phi));
  const double gain = mass * inertia;
  return {(1 - phi) * solid * area,
          phi * solid * area,
          phi,
          flux + kick,
          d_over_c,
          gradient_of(progress),
          (1 - phi) * mass,
          phi * mass,
          (1 - share) * k,
          share * k,
          -gain,
          gain};
}

/// The tables of a run of 20 windows, of grseg-segregation and of grseg-stress.
struct Tables {
  Table segregation, stress;
};
Tables tables_of(const Made& made, const std::string& input, synthetic::Ar1* noise = nullptr)
{
  Tables tables;
  auto& motion = tables.segregation;
  motion.name = input + ".segregation.tsv";
  motion.columns = with_key_columns(
      2, {"area_S[m^2]", "area_L[m^2]", "phi_L", "q_L[m/s]", "D[m^2/s]", "dphi_dy[1/m]",
          "mass_S[kg]", "mass_L[kg]", "mvv_S_yy[J]", "mvv_L_yy[J]", "gain_S_y[N]", "gain_L_y[N]"});
  std::vector<synthetic::TableRow> rows;
  for (int window = 0; window < 20; ++window) {
    const double progress = window / 19.0, begin = 1.25 * window;
    for (int n = 0; n < 10; ++n) {
      const double kick = noise ? 3e-4 * noise->normal() : 0;
      motion.rows.push_back(with_key({begin, begin + 1.25, n * layer, (n + 1) * layer, 25, area},
                                     motion_cells(made, n, progress, kick)));
      const double phi = phi_of(n, progress);
      auto sums = made.c > 0 ? synthetic::separate_sums(
                                   phi, (1 - phi) * (1 - made.b * phi) * Tensor2::Identity(),
                                   phi * (1 + made.b * (1 - phi)) * Tensor2::Identity())
                             : synthetic::neutral_sums(phi, 2);
      sums.volume = area;
      for (auto& content : sums.content) content *= area;
      rows.push_back({begin, begin + 1.25, 25, sums, n * layer, (n + 1) * layer});
    }
    motion.rows.push_back(
        with_key({begin, begin + 1.25, ClosurePoint::nan, ClosurePoint::nan, 25, 0.1},
                 std::vector<double>(12, ClosurePoint::nan)));
  }
  tables.stress = synthetic::stress_table(rows);
  tables.stress.name = input + ".stress.tsv";
  motion.header = {{"program", "grseg-segregation 0.2.0"},
                   {"small_diameter", "0.005"},
                   {"large_diameter", "0.01"},
                   {"gravity_y", format_number(-weight_of_mass)}};
  for (auto* table : {&motion, &tables.stress})
    for (const auto& [key, value] : {std::pair{"input", input.c_str()}, std::pair{"layer", "0.02"},
                                     std::pair{"window", "1.25"}})
      table->header.emplace_back(key, value);
  return tables;
}

SegregationSummary summary_of(const std::vector<Table>& tables,
                              const std::vector<PartitionRule>& rules = two_rules,
                              const ClosureFilter& filter = {})
{
  return closure_summary(read_closure(tables, rules, filter), rules, {});
}

TEST(SegregationClosure, AFluxWithoutNoiseGivesItsCoefficientsFromTablesInAnyOrder)
{
  const auto a = tables_of({}, "a"), b = tables_of({}, "b");
  auto moved = b;  // the same numbers would be the same run
  for (auto* table : {&moved.segregation, &moved.stress})
    for (auto& row : table->rows) {
      row[0] += 100;
      row[1] += 100;
    }
  const auto summary = summary_of({moved.stress, a.segregation, moved.segregation, a.stress});
  EXPECT_NEAR(number_of(summary, "B_over_c[s]").value, b_over_c, 1e-15);
  EXPECT_NEAR(number_of(summary, "d_over_c[m^2/s]").value, d_over_c, 1e-16);
  EXPECT_NEAR(number_of(summary, "D_displacements[m^2/s]").value, d_over_c, 1e-15);
}

// Neutral contacts: B by any share follows from r, and is 0 at p* = r/(1 + r) = 2/3. Layers count by
// phi_L phi_S.
TEST(SegregationClosure, CIsBOverTheFluxAndChangesItsSignAtPStar)
{
  const auto run = tables_of({}, "a");
  const auto summary = summary_of({run.segregation, run.stress});
  EXPECT_NEAR(number_of(summary, "p_zero").value, 2.0 / 3, 1e-12);
  for (const auto& rule : two_rules) {
    double b = 0, sum = 0;
    for (int window = 1; window < 20; ++window)  // the first one has none before it
      for (int n = 1; n < 9; ++n) {              // the outer layers lack a neighbour
        const double phi = phi_of(n, window / 19.0), both = phi * (1 - phi);
        b += both * neutral_b(rule, 2, phi);
        sum += both;
      }
    b /= sum;
    EXPECT_NEAR(number_of(summary, "B@" + rule.name()).value, b, 1e-12);
    EXPECT_NEAR(number_of(summary, "c@" + rule.name() + "[1/s]").value, b / b_over_c, 1e-7);
    EXPECT_NEAR(number_of(summary, "d@" + rule.name() + "[m^2/s^2]").value, b / b_over_c * d_over_c,
                1e-10);
  }
  EXPECT_GT(number_of(summary, "c@uniform:0.8[1/s]").low, 0);
  EXPECT_LT(number_of(summary, "c@half[1/s]").high, 0);
  EXPECT_TRUE(remarks_hold(summary, "uniform:0.8 +, half -; it changes at p* = 0.667"));
}

// K' = rho T' and psi_K = phi_L (1 + B_K phi_S): k_push = -B_K T' phi_L phi_S, beside a driving of
// phi_L phi_S (g + T').
TEST(SegregationClosure, AKineticPushIsMeasuredAsPartOfB)
{
  const double slope = -0.05, b_kinetic = -0.3;
  const auto run =
      tables_of({.temperature = 0.1, .temperature_slope = slope, .b_kinetic = b_kinetic}, "a");
  const auto summary = summary_of({run.segregation, run.stress});
  EXPECT_NEAR(number_of(summary, "tau_X_of_kinetic_push").value,
              -b_kinetic * slope / (weight_of_mass + slope), 1e-12);
  EXPECT_NEAR(number_of(summary, "tau_G_of_kinetic_push[m^2/s^2]").value, 0, 1e-12);
  EXPECT_NEAR(number_of(summary, "tau_X_of_inertia").value, 0, 1e-12);
}

// Large grains with their part of a uniform temperature T diffuse: k_spread = -T dphi_L/dy.
TEST(SegregationClosure, AUniformTemperatureIsMeasuredAsPartOfD)
{
  const double temperature = 0.035;
  const auto run = tables_of({.temperature = temperature}, "a");
  const auto summary = summary_of({run.segregation, run.stress});
  EXPECT_NEAR(number_of(summary, "tau_G_of_kinetic_spread[m^2/s^2]").value, temperature, 1e-12);
  EXPECT_NEAR(number_of(summary, "tau_X_of_kinetic_spread").value, 0, 1e-12);
  EXPECT_NEAR(number_of(summary, "tau_G[m^2/s^2]").value, temperature, 1e-12);
}

TEST(SegregationClosure, InertiaOfTheLargeGrainsIsMeasuredAgainstB)
{
  const auto run = tables_of({.acceleration = 0.4}, "a");
  const auto summary = summary_of({run.segregation, run.stress});
  EXPECT_NEAR(number_of(summary, "tau_X_of_inertia").value, -0.4 / weight_of_mass, 1e-12);
  EXPECT_NEAR(number_of(summary, "tau_X").value, -0.4 / weight_of_mass, 1e-12);
}

// A flux with all its terms, none of them small: only with them kept are c and d those it was made
// with.
TEST(SegregationClosure, WithAllTermsKeptCAndDAreThoseOfTheFlux)
{
  const Made made{.temperature = 0.03,
                  .temperature_slope = -0.1,
                  .b_kinetic = -0.3,
                  .acceleration = 0.2,
                  .b = 0.04,
                  .c = 120,
                  .d = 0.02};
  const auto run = tables_of(made, "a");
  const auto rules = parse_rules({"size"});
  const auto summary = summary_of({run.segregation, run.stress}, rules);
  EXPECT_NEAR(number_of(summary, "B@size").value, made.b, 1e-12);
  EXPECT_NEAR(number_of(summary, "c_kept@size[1/s]").value, made.c, 1e-6);
  EXPECT_NEAR(number_of(summary, "d_kept@size[m^2/s^2]").value, made.d, 1e-9);
  EXPECT_GT(std::abs(number_of(summary, "c@size[1/s]").value - made.c), 10);
}

TEST(SegregationClosure, TablesWithoutMassesGiveTheFluxAloneAndSaySo)
{
  auto run = tables_of({}, "a");
  run.segregation.columns.resize(12);
  for (auto& row : run.segregation.rows) row.resize(12);
  const auto summary = summary_of({run.segregation, run.stress});
  EXPECT_NEAR(number_of(summary, "B_over_c[s]").value, b_over_c, 1e-15);
  EXPECT_TRUE(remarks_hold(summary, "lack mass, mvv and gain"));
}

TEST(SegregationClosure, LayersAndWindowsAreChosenByHeightAndTime)
{
  const auto run = tables_of({}, "a");
  ClosureFilter filter;
  EXPECT_EQ(read_closure({run.segregation, run.stress}, two_rules, filter).points.size(), 8u * 19);
  filter.instruments = Instruments::same;  // needs no window before
  EXPECT_EQ(read_closure({run.segregation, run.stress}, two_rules, filter).points.size(), 8u * 20);
  filter.instruments = Instruments::previous;
  filter.heights = "8dS:24dS";  // layers 2 to 5
  filter.range.begin = 5;
  filter.range.end = 12.5;
  const auto data = read_closure({run.segregation, run.stress}, two_rules, filter);
  EXPECT_EQ(data.points.size(), 4u * 6);
  EXPECT_EQ(data.runs, RunLengths{6});
}

void expect_refusal(const std::vector<Table>& tables, const std::string& words)
{
  try {
    read_closure(tables, two_rules, {});
    ADD_FAILURE() << "accepted; expected: " << words;
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(SegregationClosure, RunsWhoseTablesDoNotBelongTogetherAreRefused)
{
  const auto a = tables_of({}, "a"), b = tables_of({}, "b");
  expect_refusal({a.segregation, b.stress},
                 "a.segregation.tsv: the table of grseg-stress of the same run (a) is not given");
  expect_refusal({a.stress}, "the table of grseg-segregation of the same run (a) is not given");
  expect_refusal({a.segregation, a.stress, a.stress}, "are both tables of grseg-stress");
  expect_refusal({a.segregation, a.stress, b.segregation, b.stress}, "all numbers are the same");
  auto shorter = a.stress;
  shorter.rows.resize(50);
  expect_refusal({a.segregation, shorter}, "has no row for the layer from 0 to 0.02 m from 6.25");
  auto thicker = a.stress;
  for (auto& [key, value] : thicker.header)
    if (key == "layer") value = "0.01";
  expect_refusal({a.segregation, thicker}, "differ in 'layer'");
}

/// Points of runs whose flux scatters by `kick` times its size, neighbouring windows by rho; `steady`:
/// the gradient stays in proportion to the driving but for a hundredth of it.
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

/// How often of `trials` the intervals hold the truth, and how far the mean is from it in units of its
/// standard error.
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
    const auto summary = closure_summary(make(noise), parse_rules({"size"}), {200, 1});
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

// From `least`, mostly 95 of 100, to 95 of 100, less or more by three standard deviations of such a
// count; the bias of a mean of many trials lies within three of its standard errors.
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

// Blocks of 120 windows with a correlation of 0.5 between neighbours hold the truth in 93 of 100 cases
// where the weight of a window changes along the run, as that of the gradient does.
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

double width_of(const SegregationSummary& summary, const std::string& name)
{
  const auto estimate = number_of(summary, name);
  return estimate.high - estimate.low;
}

// A B without noise: c = B/(B/c) is as uncertain, in parts of itself, as B/c. A psi that is off by the
// same under all rules: p* moves by that over B(1) - B(0) = 0.8.
TEST(SegregationClosure, IntervalsOfCAndPStarFollowFromThoseOfWhatTheyAreMadeOf)
{
  synthetic::Ar1 noise(0);
  auto data = noisy({60}, 0.1, noise);
  const auto sure = closure_summary(data, parse_rules({"size"}), {});
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
  const auto off = closure_summary(data, parse_rules({"size"}), {});
  EXPECT_GT(width_of(off, "B@size"), 1e-4);
  EXPECT_NEAR(width_of(off, "p_zero"), width_of(off, "B@size") / 0.8, 1e-10);
}

// One over the sine of the angle between the regressors.
TEST(SegregationClosure, CollinearRegressorsAreReportedWithWhatTheyMakeOfTheError)
{
  synthetic::Ar1 noise(0);
  const auto apart = closure_summary(noisy({60}, 0.1, noise), two_rules, {});
  EXPECT_LT(std::abs(number_of(apart, "regressor_correlation").value), 0.3);
  EXPECT_LT(number_of(apart, "error_factor").value, 1.05);
  EXPECT_FALSE(remarks_hold(apart, "collinear"));

  auto data = noisy({60}, 0.1, noise, true);
  EXPECT_GT(number_of(closure_summary(data, two_rules, {}), "error_factor").value, 100);
  data.instruments = Instruments::same;
  const auto steady = closure_summary(data, two_rules, {});
  const double r = number_of(steady, "regressor_correlation").value;
  EXPECT_GT(r, 0.9999);
  EXPECT_NEAR(number_of(steady, "error_factor").value, 1 / std::sqrt(1 - r * r), 1e-6);
  EXPECT_NEAR(number_of(steady, "condition_number").value, std::sqrt((1 + r) / (1 - r)), 1e-6);
  EXPECT_GT(number_of(steady, "estimate_correlation").value, 0.99);
  EXPECT_TRUE(remarks_hold(steady, "collinear over these rows"));
  EXPECT_GT(width_of(steady, "B_over_c[s]"), 20 * width_of(apart, "B_over_c[s]"));
}

/// A bed whose composition is moved by a flux of the closure and by noise of that flux, as in a run: the
/// noise of a window changes the gradient of the same window.
ClosureData moved_by_its_flux(synthetic::Ar1& noise, Instruments instruments)
{
  constexpr int layers = 14, windows = 60, steps = 25;
  constexpr double dt = 0.05, kick = 2e-3;  // s; m/s in one step
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

// What rises by chance makes the gradient of its window larger.
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
  const auto summary = closure_summary(data, two_rules, {});
  EXPECT_TRUE(std::isnan(number_of(summary, "B_over_c[s]").value));
  EXPECT_TRUE(remarks_hold(summary, "cannot be told apart"));
}

}  // namespace
}  // namespace grseg
