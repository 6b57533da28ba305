// SPDX-License-Identifier: GPL-3.0-or-later
// Coefficients of Gray & Thornton's closure from the flux of large grains, and their dependence on
// the rule.
#include "analysis/segregation/closure.hpp"

#include "analysis/frames/sums.hpp"
#include "analysis/segregation/prediction.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/core/errors.hpp"
#include "tests/analysis/correlated_windows.hpp"
#include "tests/analysis/segregation/closure_bed.hpp"
#include "tests/analysis/synthetic_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace grseg {
namespace {

/// Quantities from which a run is made, besides its flux.
struct Made {
  double temperature = 0, temperature_slope = 0,
         b_kinetic = 0;        // K/rho at y = 0, m^2/s^2; its derivative d/dy
  double acceleration = 0;     // a/(phi_L phi_S), m/s^2
  double b = 0, c = 0, d = 0;  // coefficients of the closure for the flux; c = 0: X and G alone
};

/// Forces per mass of a layer by their definitions; K is linear in y.
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

/// Tables of grseg-segregation and of grseg-stress for a run of 20 windows.
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
      if (!(made.c > 0))  // one stress in all layers, so that gradients add nothing to B of a layer
        for (auto* sum :
             {&sums.of(OwnSum::inside, 0), &sums.of(OwnSum::inside, 1), &sums.of(PairSum::whole, 0),
              &sums.of(PairSum::by_size, 0), &sums.of(PairSum::up_to_contact, 0)})
          *sum *= 2 - phi;
      sums.volume = area;
      for (auto& content : sums.content) content *= area;
      rows.push_back({begin, begin + 1.25, 25, sums, n * layer, (n + 1) * layer});
    }
    motion.rows.push_back(with_key({begin, begin + 1.25, no_number, no_number, 25, 0.1},
                                   std::vector<double>(12, no_number)));
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

NamedNumbers summary_of(const std::vector<Table>& tables,
                        const std::vector<PartitionRule>& rules = two_rules,
                        const ClosureFilter& filter = {})
{
  return closure_summary(read_closure(tables, rules, filter), rules);
}

TEST(SegregationClosure, CoefficientsForOtherRunsComeWithTheMeanShearOfTheFittedRows)
{
  auto tables = tables_of({}, "a");
  tables.segregation.columns.emplace_back("shear_rate[1/s]");
  for (auto& row : tables.segregation.rows) row.push_back(std::isnan(row[2]) ? -20 : no_number);
  const auto found = flux_coefficients(
      read_closure({tables.segregation, tables.stress}, two_rules, ClosureFilter{}));
  EXPECT_NEAR(found.B_over_c, b_over_c, 1e-15);
  EXPECT_NEAR(found.d_over_c, d_over_c, 1e-15);
  // phi_L is 0.35 on average over the layers, so d is 6.75 mm; its mean square is larger.
  EXPECT_NEAR(found.shear_d, 20 * 0.00675, 1e-12);
  EXPECT_GT(found.shear_d2, 20 * 0.00675 * 0.00675);
  EXPECT_LT(found.shear_d2, 20 * 0.00675 * 0.00675 * 1.1);
}

// B = 0 at every height of a linear bed; the means of its layers have the excess h^2/12 phi_L' sigma'/sigma.
TEST(SegregationClosure, GradientsInsideALayerAddNothingToB)
{
  auto run = tables_of({}, "a");
  std::vector<synthetic::TableRow> rows;
  for (int window = 0; window < 20; ++window)
    for (int n = 0; n < 10; ++n) {
      const double phi = phi_of(n, window / 19.0), stress = 20 - 1.5 * n;
      const double large = phi * stress - gradient_of(window / 19.0) * layer * 1.5 / 12;
      auto sums = synthetic::separate_sums(phi, (stress - large) * Tensor2::Identity(),
                                           large * Tensor2::Identity());
      const double begin = 1.25 * window;
      rows.push_back({begin, begin + 1.25, 25, sums, n * layer, (n + 1) * layer});
    }
  const auto header = run.stress.header;
  const auto name = run.stress.name;
  run.stress = synthetic::stress_table(rows);
  run.stress.header = header;
  run.stress.name = name;
  const auto summary = summary_of({run.segregation, run.stress});
  EXPECT_NEAR(number_of(summary, "B@half").value, 0, 1e-13);
}

TEST(SegregationClosure, AFluxWithoutNoiseGivesItsCoefficientsFromTablesInAnyOrder)
{
  const auto a = tables_of({}, "a"), b = tables_of({}, "b");
  auto moved = b;  // equal numbers would be the same run
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

// Neutral contacts: B at any share follows from r, and is 0 at p* = r/(1 + r) = 2/3. Layers have the
// weight phi_L phi_S.
TEST(SegregationClosure, CIsBOverTheFluxAndChangesItsSignAtPStar)
{
  const auto run = tables_of({}, "a");
  const auto summary = summary_of({run.segregation, run.stress});
  EXPECT_NEAR(number_of(summary, "p_zero").value, 2.0 / 3, 1e-12);
  for (const auto& rule : two_rules) {
    double b = 0, sum = 0;
    for (int window = 1; window < 20; ++window)  // the first window has no window before it
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
  EXPECT_TRUE(remarks_hold(summary, "uniform:0.8 +, half -; c is 0 at p* = 0.667"));
}

// K' = rho T' and psi_K = phi_L (1 + B_K phi_S): k_push = -B_K T' phi_L phi_S; the driving force is
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

// Large grains that have their share of a uniform temperature T diffuse: k_spread = -T dphi_L/dy.
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

// The flux has all terms, none of them small: c and d are recovered only if all terms are fitted.
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
  filter.instruments = Instruments::same;  // does not need the window before
  EXPECT_EQ(read_closure({run.segregation, run.stress}, two_rules, filter).points.size(), 8u * 20);
  filter.instruments = Instruments::previous;
  filter.heights = "8dS:24dS";  // layers 2 to 5
  filter.begin = 5;
  filter.end = 12.5;
  const auto data = read_closure({run.segregation, run.stress}, two_rules, filter);
  EXPECT_EQ(data.points.size(), 4u * 6);
  EXPECT_EQ(data.runs, RunLengths{6});
}

/// The table of the same run with all lengths and times divided by `factor`.
Table shrunk(Table table, double factor)
{
  for (auto& row : table.rows)
    for (std::size_t key = 0; key < 4; ++key) row[key] /= factor;
  for (auto& [key, value] : table.header)
    if (key == "layer" || key == "window") value = format_number(std::stod(value) / factor);
  return table;
}

// Layers of 0.2 um in windows of 12.5 us must be distinguished as well as layers of 2 cm in windows
// of 1.25 s.
TEST(SegregationClosure, ThinLayersAndShortWindowsAreToldApart)
{
  const auto run = tables_of({}, "a");
  const auto data =
      read_closure({shrunk(run.segregation, 1e5), shrunk(run.stress, 1e5)}, two_rules, {});
  EXPECT_EQ(data.points.size(), 8u * 19);
}

// If all stress is tensile, the large grains' share of it has no meaning, as in grseg-fit.
TEST(SegregationClosure, LayersUnderTensionDoNotTakePart)
{
  auto run = tables_of({}, "a");
  auto& row = run.stress.rows.at(25);  // layer 5 of the third window
  for (std::size_t c = 6; c < row.size(); ++c)
    if (run.stress.columns[c].find("[N m]") != std::string::npos) row[c] *= -1;
  EXPECT_EQ(read_closure({run.segregation, run.stress}, two_rules, {}).points.size(), 8u * 19 - 1);
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
  expect_refusal({a.segregation, shorter},
                 "there is no row for the layer from 0 to 0.02 m from 6.25");
  auto thicker = a.stress;
  for (auto& [key, value] : thicker.header)
    if (key == "layer") value = "0.01";
  expect_refusal({a.segregation, thicker}, "differ in 'layer'");
}

// The driving of the closure is of size alone, but lighter grains also rise by their weight.
TEST(SegregationClosure, GrainsOfTwoDensitiesAreRefused)
{
  auto run = tables_of({}, "a");
  for (auto* table : {&run.segregation, &run.stress})
    add_all(table->header,
            Header{{"mean_density", "1900"}, {"density_S", "1000"}, {"density_L", "2800"}});
  expect_refusal({run.segregation, run.stress}, "(small 1000, large 2800 kg/m^2)");
  try {
    predict(run.segregation, {1, 1, 1, 1}, {});
    ADD_FAILURE() << "predicted";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("differ in density"), std::string::npos);
  }
}

}  // namespace
}  // namespace grseg
