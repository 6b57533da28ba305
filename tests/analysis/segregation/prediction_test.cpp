// SPDX-License-Identifier: GPL-3.0-or-later
// Predictions of runs that were not used for the fit: synthetic runs whose motion is known.
#include "analysis/segregation/prediction.hpp"

#include "analysis/frames/sums.hpp"
#include "analysis/segregation/transport.hpp"
#include "formats/core/errors.hpp"
#include "tests/analysis/segregation/closure_bed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace grseg {
namespace {

constexpr double area = 0.007, solid = 0.8;  // of a layer, m^2; solid fraction
constexpr int layers = 15;
constexpr double height = layers * layer;  // m

/// A bed of discs of 5 and 10 mm, large grains below at first.
struct Bed {
  double shear_rate = 20;        // 1/s
  double slope = 23;             // degrees
  double dilation = 1;           // thickness of the bed after the first window over that in it
  std::vector<double> phi = {};  // first phi_L by layer; empty: 1 in the lowest six layers

  double phi_large() const
  {
    double sum = 0;
    for (const double p : start()) sum += p;
    return sum / layers;
  }
  std::vector<double> start() const
  {
    if (!phi.empty()) return phi;
    std::vector<double> below(layers, 0.0);
    std::fill_n(below.begin(), 6, 1.0);
    return below;
  }
};

/// Means over layers of the cells of a bed that moves by `law`, window after window of 5 s.
std::vector<std::vector<double>> motion(const Bed& bed, const TransportLaw& law, int windows)
{
  constexpr std::size_t per_layer = 20;
  std::vector<double> cells;
  for (const double p : bed.start()) cells.insert(cells.end(), per_layer, p);
  TransportColumn column(cells, height);
  std::vector<std::vector<double>> all;
  for (int window = 0; window < windows; ++window) {
    if (window > 0) column.advance(5, law);
    auto& phi = all.emplace_back(layers, 0.0);
    for (std::size_t k = 0; k < cells.size(); ++k) phi[k / per_layer] += column.phi_large()[k];
    for (double& mean : phi) mean /= per_layer;
  }
  return all;
}

/// A table of grseg-segregation of a bed that moves by `law`.
Table table_of(const Bed& bed, const TransportLaw& law, int windows = 7)
{
  Table table;
  table.name = "held-out.tsv";
  table.columns = with_key_columns(2, {"area_S[m^2]", "area_L[m^2]", "shear_rate[1/s]"});
  constexpr double pi = 3.14159265358979;
  table.header = {{"program", "grseg-segregation 1.0.0"},
                  {"input", "xxh3 0"},
                  {"small_diameter", "0.005"},
                  {"large_diameter", "0.01"},
                  {"gravity_x", format_number(9.8 * std::sin(bed.slope * pi / 180))},
                  {"gravity_y", format_number(-9.8 * std::cos(bed.slope * pi / 180))}};
  const auto all = motion(bed, law, windows);
  for (int window = 0; window < windows; ++window) {
    const double begin = 5 * window, thick = layer * (window > 0 ? bed.dilation : 1);
    for (int n = 0; n < layers; ++n) {
      const double phi = all[static_cast<std::size_t>(window)][static_cast<std::size_t>(n)];
      table.rows.push_back(with_key({begin, begin + 5, n * thick, (n + 1) * thick, 100, area},
                                    {(1 - phi) * solid * area, phi * solid * area, no_number}));
    }
    table.rows.push_back(with_key({begin, begin + 5, no_number, no_number, 100, layers * area},
                                  {no_number, no_number, bed.shear_rate}));
  }
  return table;
}

const FluxCoefficients fitted{b_over_c, d_over_c, 20 * 0.007, 20 * 0.007 * 0.007};

TransportLaw uniform(double S, double D)
{
  return [=](double, double) { return TransportRates{S, D}; };
}

double g_cos(const Bed& bed)
{
  return 9.8 * std::cos(bed.slope * 3.14159265358979 / 180);
}

double number(const Prediction& prediction, const std::string& name, const std::string& unit = "")
{
  NamedNumbers numbers;
  add_predictions(numbers, {prediction},
                  [](double value, const std::array<double, 2>&) { return Estimate{value}; });
  return number_of(numbers, name + "@held-out.tsv" + unit).value;
}

TEST(Prediction, ARunThatMovesByTheFittedCoefficientsIsPredicted)
{
  const Bed bed;
  const auto run = table_of(bed, uniform(b_over_c * g_cos(bed), d_over_c));
  const auto prediction = predict(run, fitted, {});
  // The bed's cells are finer than those of the prediction, whose error is of second order.
  EXPECT_LT(number(prediction, "rms_phi_L_of_closure"), 1e-3);
  EXPECT_LT(number(prediction, "rms_y_L_of_closure", "[m]"), 1e-4);
  EXPECT_GT(number(prediction, "rms_phi_L_of_unchanged"), 0.2);
}

TEST(Prediction, RatesOfTheClosureScaleWithTheShearOfThePredictedBed)
{
  // Half the shear rate of the fit, and another mixture: S changes with shear rate x d and D with
  // shear rate x d^2.
  Bed bed{.shear_rate = 10, .slope = 20, .phi = std::vector<double>(layers, 0.0)};
  std::fill_n(bed.phi.begin(), 9, 1.0);
  const double d = (1 + bed.phi_large()) * 0.005;
  const auto run = table_of(bed, uniform(b_over_c * g_cos(bed) * 10 * d / fitted.shear_d,
                                         d_over_c * 10 * d * d / fitted.shear_d2));
  const auto prediction = predict(run, fitted, {});
  EXPECT_LT(number(prediction, "rms_phi_L_of_closure"), 1e-3);
  // The rates of the fit, without the scaling, are far off.
  const FluxCoefficients own{b_over_c, d_over_c, 10 * d, 10 * d * d};
  EXPECT_GT(number(predict(run, own, {}), "rms_phi_L_of_closure"), 0.05);
}

TEST(Prediction, TrewhelasLawTakesThePressureOfTheGrainsAboveAndTheLocalComposition)
{
  const Bed bed;
  const double cosine = g_cos(bed) / 9.8;
  for (const bool intruder : {false, true}) {
    const auto run = table_of(bed, [=](double y, double phi) {
      const double d = 0.005 * (1 + phi), shear = 20 * d * d;
      return TransportRates{0.3744 * shear * (1 + (intruder ? 0 : 2.0957 * phi)) /
                                (0.2712 * d + solid * (height - y) * cosine),
                            0.108 * shear};
    });
    const std::string name = intruder ? "trewhela_intruder" : "trewhela";
    const auto prediction = predict(run, fitted, {});
    EXPECT_LT(number(prediction, "rms_phi_L_of_" + name), 1e-3) << name;
  }
}

TEST(Prediction, ABedThatDilatesIsTheSameBed)
{
  const Bed bed{.dilation = 1.1};
  const auto run = table_of(bed, uniform(b_over_c * g_cos(bed), d_over_c));
  const auto prediction = predict(run, fitted, {});
  EXPECT_LT(number(prediction, "rms_phi_L_of_closure"), 1e-3);
}

TEST(Prediction, EveryLawKeepsTheLargeGrainsOfTheFirstWindow)
{
  const Bed bed;
  auto run = table_of(bed, uniform(0, 0));
  double large = 0;  // m^2
  for (auto& row : run.rows) {
    const double looser = 1 - 0.5 * row[2] / height;  // the higher the layer, the fewer its grains
    row[6] *= looser;
    row[7] *= looser;
    if (row[0] == 0 && !std::isnan(row[2])) large += row[7];
  }
  for (const auto& window : predict(run, fitted, {}).windows)
    for (std::size_t law = 0; law < prediction_laws.size(); ++law) {
      double predicted = 0;
      for (const auto& of : window.layers) predicted += of.content * of.predicted[law];
      EXPECT_NEAR(predicted / large, 1, 1e-12) << prediction_laws[law];
    }
}

TEST(Prediction, AMeasurementThatStandsStillIsThatFarFromItsPrediction)
{
  // phi_L is 0.4 everywhere and stays so. Without diffusion the small grains gather at the base and
  // the large ones at the surface; what each layer is off by follows from the closed form.
  const Bed bed{.phi = std::vector<double>(layers, 0.4)};
  const FluxCoefficients sorting{0.05, 0.0, 0.14, 0.00098};
  const auto prediction = predict(table_of(bed, uniform(0, 0), 2), sorting, {});
  // phi_L is 0 in the lowest 9 layers and 1 in the upper 6: rms sqrt(0.6 0.4^2 + 0.4 0.6^2). The two
  // cells at the edge end with e and 1 - e, and e decreases as cell/(S time).
  const double edge = height / 200 / (sorting.B_over_c * g_cos(bed) * 5);
  EXPECT_NEAR(number(prediction, "rms_phi_L_of_closure"), std::sqrt(0.24), edge);
  EXPECT_NEAR(number(prediction, "y_L_last", "[m]"), height / 2, 1e-12);
  EXPECT_NEAR(number(prediction, "y_L_last_of_closure", "[m]"), 12 * layer, 1e-6);
  EXPECT_NEAR(number(prediction, "rms_y_L_of_closure", "[m]"), 4.5 * layer, 1e-6);
  EXPECT_NEAR(number(prediction, "rms_phi_L_of_unchanged"), 0, 1e-12);
}

TEST(Prediction, TheHeightOfLargeGrainsFollowsBOverCAsItsClosedFormDoes)
{
  // From phi_L = p everywhere, without diffusion, pure layers grow at base and surface with speeds
  // S (1 - p) and S p: y_L = H/2 + (1 - p) (S t - (S t)^2/2H) until they meet.
  const double p = 0.4, t = 5;
  const Bed bed{.phi = std::vector<double>(layers, p)};
  FluxCoefficients sorting = fitted;
  sorting.B_over_c = 0.4 * height / (t * g_cos(bed));
  sorting.d_over_c = 0;
  const double S = sorting.B_over_c * g_cos(bed);
  const auto prediction = predict(table_of(bed, uniform(0, 0), 2), sorting, {});
  const double cell = height / 200;  // how far a shock may be from its place
  EXPECT_NEAR(number(prediction, "y_L_last_of_closure", "[m]"),
              height / 2 + (1 - p) * (S * t - S * t * S * t / (2 * height)), cell);
  const double slope = (1 - p) * (t - S * t * t / height) * g_cos(bed);
  EXPECT_NEAR(prediction.slopes[0] / slope, 1, 0.02);
}

TEST(Prediction, TheHeightOfLargeGrainsFollowsDOverCAsItsClosedFormDoes)
{
  // phi_L = p + a cos(pi y/H) decays with the rate D pi^2/H^2, so
  // y_L = H/2 - 2 a H/(pi^2 p) exp(-D pi^2 t/H^2).
  constexpr double pi = 3.14159265358979, p = 0.4, a = 0.3, t = 5;
  Bed bed{.phi = std::vector<double>(layers)};
  for (int n = 0; n < layers; ++n)
    bed.phi[static_cast<std::size_t>(n)] = p + a * std::cos(pi * (n + 0.5) / layers);
  FluxCoefficients mixing = fitted;
  mixing.B_over_c = 1e-9;
  mixing.d_over_c = 0.5 * height * height / (pi * pi * t);
  const auto prediction = predict(table_of(bed, uniform(0, 0), 2), mixing, {});
  const double slope =
      2 * a * height / (pi * pi * p) * std::exp(-0.5) * pi * pi * t / (height * height);
  // phi_L is constant within each layer, here at first and in y_L: (pi/15)^2/24 each.
  EXPECT_NEAR(prediction.slopes[1] / slope, 1, 4 * pi * pi / (layers * layers * 24));
}

TEST(Prediction, TheTableHoldsMeasuredAndPredictedCompositionByLayer)
{
  const Bed bed;
  const auto run = table_of(bed, uniform(0, 0), 3);
  const auto prediction = predict(run, fitted, {});
  const auto table = prediction_table({prediction, prediction});
  ASSERT_EQ(table.rows.size(), 2u * 3 * layers);
  EXPECT_EQ(table.rows.front()[table.column("run")], 1);
  EXPECT_EQ(table.rows.back()[table.column("run")], 2);
  const auto& row = table.rows[2 * layers + 5];  // the sixth layer in the third window
  EXPECT_EQ(row[table.column("t0")], 10);
  EXPECT_NEAR(row[table.column("solid")], solid, 1e-12);
  EXPECT_EQ(row[table.column("phi_L")], 1);
  EXPECT_NEAR(row[table.column("phi_L_unchanged")], 1, 1e-12);
  EXPECT_LT(row[table.column("phi_L_closure")], 0.9);
}

TEST(Prediction, ARunOfTheFitIsNotPredicted)
{
  const Bed bed;
  auto run = table_of(bed, uniform(0, 0), 3);
  run.columns.back() = "q_L[m/s]";
  auto longer = run;
  longer.name = "fit.tsv";
  EXPECT_THROW(refuse_fitted_runs({run}, {longer}), UsageError);
  for (auto& [key, value] : longer.header)
    if (key == "input") value = "xxh3 1";
  for (auto& row : longer.rows) row[6] /= 2;  // other grains
  EXPECT_NO_THROW(refuse_fitted_runs({run}, {longer}));
}

TEST(Prediction, ASingleWindowPredictsNothing)
{
  EXPECT_THROW(predict(table_of({}, uniform(0, 0), 1), fitted, {}), RunError);
}

TEST(Prediction, ShearRatesAreNeededOfThePredictedAndOfTheFittedRuns)
{
  auto run = table_of({}, uniform(0, 0), 3);
  EXPECT_THROW(predict(run, {b_over_c, d_over_c}, {}), RunError);
  EXPECT_THROW(predict(run, {}, {}), RunError);
  run.rows.pop_back();  // of the bed in the last window
  EXPECT_THROW(predict(run, fitted, {}), FormatError);
}

TEST(Prediction, TheDirectionOfFlowDoesNotMatter)
{
  const Bed forward{}, backward{.shear_rate = -20};
  const auto a = predict(table_of(forward, uniform(0, 0), 3), fitted, {});
  const auto b = predict(table_of(backward, uniform(0, 0), 3), fitted, {});
  EXPECT_EQ(number(a, "rms_phi_L_of_closure"), number(b, "rms_phi_L_of_closure"));
}

}  // namespace
}  // namespace grseg
