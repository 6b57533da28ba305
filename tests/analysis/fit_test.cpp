// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit_data.hpp"
#include "analysis/fit_report.hpp"
#include "analysis/partition_scan.hpp"
#include "analysis/segregation_fit.hpp"
#include "formats/errors.hpp"
#include "tests/analysis/synthetic_sums.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace grseg {
namespace {

using synthetic::any_tensor;
using synthetic::neutral_sums;
using synthetic::separate_sums;
using synthetic::stress_table;
using synthetic::TableRow;

const std::vector<double> compositions{0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95};

/// Points y = k x^a in one window, of unequal weights.
std::vector<FitPoint> power_law(double k, double a)
{
  std::vector<FitPoint> points;
  for (const double phi : compositions) {
    FitPoint point{.phi_large = phi, .weight = 1 + 3 * phi, .size_ratio = 2};
    point.large = 1.7;
    point.small = 1.7 * k * std::pow(point.ratio(), a);
    point.total = point.small + point.large;
    points.push_back(point);
  }
  return points;
}

/// A number that looks random in [-1, 1] and is the same everywhere.
double scatter(std::size_t k)
{
  return std::sin(12.9898 * static_cast<double>(k + 1));
}

/// 30 windows of 7 layers: neutral contacts whose mixed part scatters by `noise`.
std::vector<TableRow> neutral_rows(double noise, double r = 2, int windows = 30)
{
  std::vector<TableRow> rows;
  for (int window = 0; window < windows; ++window)
    for (const double phi : compositions) {
      auto sums = neutral_sums(phi, r);
      const double factor = 1 + noise * scatter(rows.size());
      sums.ll *= factor;
      rows.push_back({1.25 * window, 1.25 * (window + 1), 25, sums});
    }
  return rows;
}

FitData read(const std::vector<Table>& tables, const FitFilters& filters = {},
             Quantity quantity = Quantity::contact)
{
  return read_fit_data(tables, quantity, filters, {});
}

FitData neutral_data(double noise)
{
  return read({stress_table(neutral_rows(noise))});
}

Bootstrap no_bootstrap(const FitData& data)
{
  return Bootstrap(data.runs, 0, 1);
}

RuleFit fit(const FitData& data, const std::string& rule, const FitSettings& settings = {})
{
  return fit_rule(data, parse_rule(rule), settings, no_bootstrap(data));
}

template <class Error>
std::string sentence_of(const std::vector<Table>& tables, const FitFilters& filters = {},
                        Quantity quantity = Quantity::contact)
{
  try {
    read(tables, filters, quantity);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool holds(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

// ---- estimators ---------------------------------------------------------------------------------

TEST(Estimators, AnExactSlopeComesBackFromEveryFit)
{
  const double s = 0.83;
  const auto b = estimate(power_law(s, 1));
  EXPECT_NEAR(b.slope, s, 1e-13);
  EXPECT_NEAR(b.slope_linear, s, 1e-13);
  EXPECT_NEAR(b.prefactor_power, s, 1e-13);
  EXPECT_NEAR(b.exponent, 1, 1e-13);
  EXPECT_NEAR(b.B_half, 2 * (1 - s) / (1 + s), 1e-13);
  EXPECT_NEAR(b.B_mean, -std::log(s), 1e-13);
  EXPECT_NEAR(b.B_pure_large, 1 - s, 1e-13);
  EXPECT_NEAR(b.B_pure_small, (1 - s) / s, 1e-13);
  EXPECT_NEAR(b.B_linear, b.B_half, 1e-13);
  EXPECT_NEAR(b.B_power, b.B_half, 1e-13);
}

TEST(Estimators, APowerLawKeepsItsExponentWhateverTheWeights)
{
  const auto b = estimate(power_law(1.44, 1.0057));
  EXPECT_NEAR(b.exponent, 1.0057, 1e-12);
  EXPECT_NEAR(b.prefactor_power, 1.44, 1e-12);
}

// Staron & Phillips (2015): slope 0.9660 "B between 0.034 and 0.035"; slope 1.4413 "B = -0.373",
// the half-sum of the ends of a range from -0.4413 to -0.3062.
TEST(Estimators, ThePapersSlopesGiveThePapersB)
{
  const auto contact = estimate(power_law(0.966, 1));
  EXPECT_NEAR(contact.B_pure_large, 0.0340, 5e-5);
  EXPECT_NEAR(contact.B_pure_small, 0.0352, 5e-5);
  const auto kinetic = estimate(power_law(1.4413, 1));
  EXPECT_NEAR(kinetic.B_pure_large, -0.4413, 5e-5);
  EXPECT_NEAR(kinetic.B_pure_small, -0.3062, 5e-5);
  EXPECT_NEAR(kinetic.B_half_sum, -0.3737, 1e-4);
  EXPECT_NEAR(kinetic.B_half, -0.3615, 1e-4);
}

// Gray & Thornton (2005) itself, psi_L = phi_L (1 + B phi_S): the direct estimate is exact for it.
TEST(Estimators, ConstantBOfGrayAndThorntonIsFoundDirectly)
{
  const double b = 0.31;
  auto points = power_law(1, 1);
  for (auto& point : points) {
    const double psi = point.phi_large * (1 + b * (1 - point.phi_large));
    point.total = 5;
    point.large = 5 * psi;
    point.small = 5 * (1 - psi);
  }
  EXPECT_NEAR(estimate(points).B_direct, b, 1e-13);
}

// Two layers: (x, y) = (1/4, 1/2) of weight 3 and (4, 2) of weight 1. ln(y/x) = ln 2 and -ln 2, so
// the weighted mean is (3 - 1)/4 ln 2. The line through the origin: (1/8 + 8)/(1/16 + 16).
// Power law: the logarithms lie on a line of slope ln 4/ln 16.
// B_direct: psi_L - phi_L = 2/3 - 4/5 and 1/3 - 1/5, phi_L phi_S = 4/25 in both.
TEST(Estimators, TwoLayersByHand)
{
  const std::vector<FitPoint> points{
      {.phi_large = 0.8, .weight = 3, .size_ratio = 2, .small = 1, .large = 2, .total = 3},
      {.phi_large = 0.2, .weight = 1, .size_ratio = 2, .small = 2, .large = 1, .total = 3}};
  const auto b = estimate(points);
  EXPECT_NEAR(b.slope, std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(b.slope_linear, (1. / 8 + 8) / (1. / 16 + 16), 1e-14);
  EXPECT_NEAR(b.exponent, 0.5, 1e-14);
  EXPECT_NEAR(b.prefactor_power, 1, 1e-14);
  EXPECT_NEAR(b.B_direct, (3 * (2. / 3 - 0.8) + (1. / 3 - 0.2)) / (4 * 0.16), 1e-14);
}

TEST(Estimators, SumsOverWindowsSayTheSameAsGslsFitsOfThePoints)
{
  std::vector<FitPoint> points;
  for (std::size_t k = 0; k < 200; ++k) {
    FitPoint point{.window = k % 11, .phi_large = 0.5 + 0.49 * scatter(k), .size_ratio = 2};
    point.weight = 2 + scatter(3 * k);
    point.large = point.phi_large * (1 + 0.2 * scatter(7 * k + 1));
    point.small = 1 - point.phi_large + (k == 17 ? -1 : 0);  // one without a logarithm
    point.total = point.large + point.small;
    points.push_back(point);
  }
  const auto by_points = estimate(points);
  const auto by_sums = estimate_from_sums(window_sums(points, {4, 7}).colwise().sum());
  for (const auto& [name, place] : estimator_names)
    EXPECT_NEAR(by_sums.*place, by_points.*place, 1e-12) << name;
}

TEST(Estimators, AStressThatIsNotPositiveCountsForTheDirectEstimateOnly)
{
  auto points = power_law(0.9, 1);
  const auto before = estimate(points);
  points.push_back(
      {.phi_large = 0.02, .weight = 1, .size_ratio = 2, .small = 3, .large = -0.1, .total = 2.9});
  const auto after = estimate(points);
  EXPECT_EQ(after.slope, before.slope);
  EXPECT_EQ(after.slope_linear, before.slope_linear);
  EXPECT_LT(after.B_direct, before.B_direct);
}

TEST(Estimators, OneCompositionHasASlopeButNoExponent)
{
  const std::vector<FitPoint> points(
      3, {.phi_large = 0.3, .weight = 1, .size_ratio = 2, .small = 2, .large = 1, .total = 3});
  EXPECT_NEAR(estimate(points).slope, 2 / (0.7 / 0.3), 1e-14);
  EXPECT_TRUE(std::isnan(estimate(points).exponent));
  EXPECT_TRUE(std::isnan(estimate_from_sums(window_sums(points, {1}).row(0)).exponent));
}

// ---- rules on neutral contacts ------------------------------------------------------------------

TEST(NeutralContacts, SharedBySizeDoNotSegregateByAnyEstimator)
{
  const auto data = neutral_data(0);
  for (const char* rule : {"size", "contact-point"})
    for (const auto component : {Component::yy, Component::pressure}) {
      const auto b = fit(data, rule, {.component = component}).value;
      for (const double value :
           {b.B_half, b.B_mean, b.B_half_sum, b.B_linear, b.B_power, b.B_direct})
        EXPECT_NEAR(value, 0, 1e-12);
      EXPECT_NEAR(b.exponent, 1, 1e-12);
    }
}

TEST(NeutralContacts, SharedOtherwiseShowExactlyTheClosedForm)
{
  const auto data = neutral_data(0);
  for (const char* rule : {"uniform:0.8", "uniform:0.6", "uniform:0.5", "half"}) {
    const auto result = fit(data, rule);
    EXPECT_NEAR(result.value.B_direct, result.neutral, 1e-12) << rule;
    EXPECT_NEAR(result.minus_size, result.neutral, 1e-12) << rule;
  }
  EXPECT_EQ(fit(data, "size").neutral, 0);
  EXPECT_EQ(fit(data, "half").neutral, fit(data, "uniform:0.5").neutral);
}

TEST(NeutralContacts, DisturbedOnesShowInTheDifferenceToSizeWhatTheRuleAdds)
{
  const auto data = neutral_data(0.1);
  const auto size = fit(data, "size"), other = fit(data, "uniform:0.8");
  EXPECT_GT(std::abs(size.value.B_direct), 1e-4);
  EXPECT_NEAR(other.minus_size, other.value.B_direct - size.value.B_direct, 1e-15);
  EXPECT_EQ(size.minus_size, 0);
}

// r = 2: (0.8 - 2/3) 3/(1 + phi_S) with the weights w (phi_L phi_S)^2 of two layers, where w is the
// number of the rarer grains: phi_L/4 of large ones at 0.2, at 0.8 phi_S = 0.2 of small against
// 0.8/4 of large, i.e. four times as many.
TEST(NeutralContacts, TheClosedFormIsAveragedWithTheWeightsOfTheDirectEstimate)
{
  const auto data =
      read({stress_table({{0, 1, 10, neutral_sums(0.2, 2)}, {0, 1, 10, neutral_sums(0.8, 2)}})});
  const double low = (0.8 - 2. / 3) * 3 / 1.8, high = (0.8 - 2. / 3) * 3 / 1.2;
  EXPECT_NEAR(fit(data, "uniform:0.8").neutral, (low + 4 * high) / 5, 1e-14);
}

// Without mixed contacts y = A_SS/A_LL = (x_S/x_L)^2 2/(2 r), and x_S/x_L = r phi_S/phi_L.
TEST(NeutralContacts, DroppedMixedContactsLeaveAParabolaAndNoB)
{
  const auto result = fit(neutral_data(0), "drop");
  EXPECT_NEAR(result.value.exponent, 2, 1e-12);
  EXPECT_NEAR(result.value.prefactor_power, 2, 1e-12);
  EXPECT_FALSE(std::isnan(result.value.slope));
  for (const auto& [name, place] : estimator_names)
    EXPECT_EQ(std::isnan(result.value.*place), name[0] == 'B') << name;
  EXPECT_TRUE(std::isnan(result.neutral));
  EXPECT_TRUE(std::isnan(result.minus_size));
}

// ---- scan ---------------------------------------------------------------------------------------

TEST(PartitionScan, EveryShareIsTheSingleFitOfItsRule)
{
  const auto data = neutral_data(0.1);
  const Bootstrap bootstrap(data.runs, 200, 4);
  const auto scan = scan_partition(data, parse_scan("0.4:0.9:0.1"), {}, bootstrap);
  ASSERT_EQ(scan.fits.size(), 6u);
  for (const auto& one : scan.fits) {
    const auto single =
        fit_rule(data, {PartitionRule::Kind::uniform, one.rule.value}, {}, bootstrap);
    EXPECT_NEAR(one.value.B_half, single.value.B_half, 1e-12);
    EXPECT_NEAR(one.low.B_half, single.low.B_half, 1e-12);
    EXPECT_NEAR(one.high.B_direct, single.high.B_direct, 1e-12);
  }
}

// B_half = 2 (1 - s)/(1 + s) has the slope of -ln s at s = 1, and there the neutral model gives
// -d ln(y)/dp = m/(psi_S psi_L) = (1 + r)/(phi_L + r phi_S), averaged with the weights of the
// slope.
TEST(PartitionScan, NeutralContactsHaveNoSegregationAtTheShareBySize)
{
  for (const double r : {2.0, 3.0}) {
    const auto data = read({stress_table(neutral_rows(0, r), 0.005, 0.005 * r)});
    const auto scan = scan_partition(data, parse_scan("0.4:0.9:0.005"), {}, no_bootstrap(data));
    double weight = 0, slope = 0;
    for (const auto& sample : data.samples) {
      weight += sample.weight;
      slope += sample.weight * (1 + r) / (sample.phi_large + r * (1 - sample.phi_large));
    }
    EXPECT_NEAR(scan.p_zero, r / (1 + r), 1e-12);
    EXPECT_NEAR(scan.dB_dp, slope / weight, 1e-10);
    EXPECT_TRUE(std::isnan(scan.p_low));
  }
}

TEST(PartitionScan, TheIntervalOfTheZeroHoldsIt)
{
  const auto data = neutral_data(0.2);
  const auto scan =
      scan_partition(data, parse_scan("0.5:0.8:0.01"), {}, Bootstrap(data.runs, 500, 1));
  EXPECT_LT(scan.p_low, scan.p_zero);
  EXPECT_GT(scan.p_high, scan.p_zero);
}

TEST(PartitionScan, ARangeWithoutAZeroSaysSo)
{
  const auto data = neutral_data(0);
  const auto scan = scan_partition(data, parse_scan("0.7:0.9:0.1"), {}, no_bootstrap(data));
  EXPECT_TRUE(std::isnan(scan.p_zero));
  EXPECT_TRUE(std::isnan(scan.dB_dp));
}

TEST(PartitionScan, SharesAreExactAndIncludeTheLast)
{
  const auto shares = parse_scan("0.4:0.9:0.005").shares();
  ASSERT_EQ(shares.size(), 101u);
  EXPECT_EQ(shares[40], 0.6);
  EXPECT_EQ(shares[100], 0.9);
  EXPECT_EQ(parse_scan("0:0.3:0.1").shares().size(), 4u);  // 0.3/0.1 is below 3 in binary
  for (const char* wrong : {"0.4:0.9", "0.4:0.9:0", "0.9:0.4:0.1", "0:1.1:0.1", "a:b:c", "0:1:0.1x",
                            "0:1:1e-9", "nan:1:0.1"})
    EXPECT_THROW(parse_scan(wrong), UsageError) << wrong;
}

// ---- reading and filters ------------------------------------------------------------------------

TEST(FitData, AWeightIsFramesTimesGrainsOfTheRarerSpecies)
{
  const auto data =
      read({stress_table({{0, 1, 10, neutral_sums(0.2, 2)}, {0, 1, 30, neutral_sums(0.9, 2)}})});
  // Large grains per small area: phi_L/4 = 0.05 against 0.8; then 0.225 against phi_S = 0.1.
  EXPECT_NEAR(data.samples[1].weight / data.samples[0].weight, 3 * 0.1 / 0.05, 1e-12);
  EXPECT_NEAR(data.samples[0].phi_large, 0.2, 1e-15);
  EXPECT_EQ(data.samples[0].size_ratio, 2);
}

TEST(FitData, LayersOfOneWindowShareItAndRunsFollowOneAnother)
{
  const auto sums = neutral_sums(0.3, 2);
  const auto a = stress_table({{0, 1, 9, sums}, {0, 1, 9, sums}, {1, 2, 9, sums}});
  const auto b = stress_table({{1, 2, 9, sums}, {0, 1, 9, sums}});
  const auto data = read({a, b});
  EXPECT_EQ(data.runs, (RunLengths{2, 2}));
  std::vector<std::size_t> windows;
  for (const auto& sample : data.samples) windows.push_back(sample.window);
  EXPECT_EQ(windows, (std::vector<std::size_t>{0, 0, 1, 3, 2}));
}

TEST(FitData, EachFilterCountsWhatItRemoves)
{
  auto rows = std::vector<TableRow>(5, {2, 3, 9, neutral_sums(0.5, 2)});
  rows.push_back({0, 1, 9, neutral_sums(0.5, 2)});        // too early
  rows.push_back({8, 9, 9, neutral_sums(0.5, 2)});        // too late
  rows.push_back({2, 3, 9, neutral_sums(0.5, 2, 0.39)});  // thin: below half of 0.8
  rows.push_back({2, 3, 9, neutral_sums(0.5, 2, 0.41)});  // just not
  rows.push_back({2, 3, 9, neutral_sums(0.005, 2)});      // x = 199
  rows.push_back({2, 3, 9, separate_sums(0, any_tensor(), Tensor2::Zero())});
  rows.push_back({2, 3, 9, separate_sums(1, Tensor2::Zero(), any_tensor())});
  ContactSums nothing;
  nothing.volume = 1;
  rows.push_back({2, 3, 9, nothing});
  const auto data = read({stress_table(rows)}, {.begin = 2, .end = 8});
  EXPECT_EQ(data.count.sentence(),
            "13 rows, 2 outside --begin and --end, 1 without grains, 1 without small grains, 1 "
            "without large grains, 1 outside --ratio-range, 1 below --min-solid");
  EXPECT_EQ(data.count.used, 6u);
  EXPECT_EQ(data.samples.size(), 6u);
}

TEST(FitData, LayersTakePartThatLieWhollyBetweenTheHeights)
{
  std::vector<TableRow> rows;
  for (int layer = 0; layer < 4; ++layer)
    rows.push_back({0, 1, 9, neutral_sums(0.5, 2), 0.02 * layer, 0.02 * (layer + 1)});
  const auto used = [&](const char* lowest, const char* highest) {
    return read({stress_table(rows)}, {.lowest = lowest, .highest = highest}).count.used;
  };
  EXPECT_EQ(used("", ""), 4u);
  EXPECT_EQ(used("4dS", ""), 3u);
  EXPECT_EQ(used("4dS", "12dS"), 2u);
  EXPECT_EQ(used("", "0.059"), 2u);
  const auto sentence = sentence_of<RunError>({stress_table(rows)}, {.lowest = "1"});
  EXPECT_TRUE(holds(sentence, "4 outside --heights"));
  EXPECT_THROW(used("4", "five"), UsageError);
}

TEST(FitData, WhereNothingIsLeftTheSentenceNamesTheFilter)
{
  const auto table = stress_table(neutral_rows(0));
  EXPECT_TRUE(holds(sentence_of<RunError>({table}, {.ratio_low = 500, .ratio_high = 600}),
                    "210 outside --ratio-range"));
  EXPECT_TRUE(holds(sentence_of<RunError>({table}, {.min_solid = 1.5}), "210 below --min-solid"));
  EXPECT_TRUE(holds(sentence_of<RunError>({table}, {.begin = 1000}), "--begin"));
  EXPECT_TRUE(holds(sentence_of<RunError>({stress_table({})}), "0 rows"));
}

TEST(FitData, AnEmptySpeciesIsNamed)
{
  const auto only_small =
      stress_table({{0, 1, 9, separate_sums(0, any_tensor(), Tensor2::Zero())}});
  const auto sentence = sentence_of<RunError>({only_small});
  EXPECT_TRUE(holds(sentence, "1 without large grains"));
  EXPECT_TRUE(holds(sentence, "both species"));
}

TEST(FitData, TheSameWindowsOfTheSameRunAreNotCountedTwice)
{
  auto early = stress_table({{0, 1, 9, neutral_sums(0.5, 2)}});
  auto late = stress_table({{1, 2, 9, neutral_sums(0.5, 2)}});
  early.header.emplace_back("input", "run.h5 0123456789abcdef");
  late.header.emplace_back("input", "run.h5 0123456789abcdef");
  EXPECT_EQ(sentence_of<UsageError>({early, late}), "");
  EXPECT_TRUE(holds(sentence_of<UsageError>({early, late, early}), "counted twice"));
}

Table kinetic_table(double slope)
{
  Table table;
  table.name = "kinetic.tsv";
  table.header = {{"small_diameter", "0.005"}, {"large_diameter", "0.01"}};
  table.columns = {"t0[s]",      "t1[s]",      "y0[m]",     "y1[m]",     "frames",    "V[m^2]",
                   "mass_S[kg]", "mass_L[kg]", "K_S_xx[J]", "K_S_yy[J]", "K_L_xx[J]", "K_L_yy[J]"};
  for (const double phi : compositions)
    table.rows.push_back(
        {0, 1, 0, 0.02, 25, 2, 1 - phi, phi, 9 * (1 - phi), slope * (1 - phi), phi, phi});
  return table;
}

// The slope of the kinetic stresses is the ratio of the mean squared fluctuations (mass-weighted).
TEST(FitData, KineticStressesAreFittedWithMassesForComposition)
{
  const auto data = read({kinetic_table(1.44)}, {}, Quantity::kinetic);
  const auto yy = fit(data, "size");
  EXPECT_NEAR(yy.value.slope, 1.44, 1e-13);
  EXPECT_NEAR(yy.value.B_half, 2 * (1 - 1.44) / 2.44, 1e-13);
  EXPECT_TRUE(std::isnan(yy.neutral));
  EXPECT_TRUE(std::isnan(yy.minus_size));
  EXPECT_NEAR(fit(data, "size", {.component = Component::pressure}).value.slope, (9 + 1.44) / 2,
              1e-13);
}

TEST(FitData, ATableOfAnotherToolIsRefusedWithTheNameOfTheRightOne)
{
  EXPECT_TRUE(
      holds(sentence_of<FormatError>({stress_table(neutral_rows(0))}, {}, Quantity::kinetic),
            "grseg-kinetic"));
  EXPECT_TRUE(holds(sentence_of<FormatError>({kinetic_table(1)}), "grseg-stress"));
}

TEST(FitData, BaseContactsCountAsFarAsTheChosenBaseSays)
{
  auto sums = separate_sums(0.5, Tensor2::Identity(), Tensor2::Identity());
  sums.base_small = 2 * Tensor2::Identity();
  sums.whole_small = 6 * Tensor2::Identity();
  const auto data = read({stress_table({{0, 1, 9, sums}})});
  EXPECT_NEAR(fit(data, "size", {.base = BasePart::contact_point}).value.slope, 3, 1e-14);
  EXPECT_NEAR(fit(data, "size", {.base = BasePart::half}).value.slope, 4, 1e-14);
  EXPECT_NEAR(fit(data, "size", {.base = BasePart::none}).value.slope, 1, 1e-14);
}

// ---- intervals and report -----------------------------------------------------------------------

// One layer per window, all of one composition and weight: B_mean is the plain mean of -ln(y/x), so
// its interval is that of a mean. 40 windows with ln(y/x) = +-0.1 in an order without correlation:
// standard deviation 0.1 sqrt(40/39), Student's t for 39 degrees of freedom 2.0227.
TEST(Intervals, OfIndependentWindowsAreThoseOfAMean)
{
  std::vector<TableRow> rows;
  for (int k = 0; k < 40; ++k) {
    // + - + + - - - + and its negative: correlations of neighbours cancel to a few per cent.
    const double sign = "+-++---+-+--+++-"[k % 16] == '+' ? 1 : -1;
    rows.push_back({1.0 * k, k + 1.0, 10,
                    separate_sums(0.5, std::exp(0.1 * sign) * any_tensor(), any_tensor())});
  }
  const auto data = read({stress_table(rows)});
  const auto result = fit_rule(data, {}, {}, Bootstrap(data.runs, 4000, 1));
  EXPECT_EQ(result.dependence.block, 1u);
  EXPECT_NEAR(result.dependence.effective_windows, 40, 1e-9);
  EXPECT_NEAR(result.value.B_mean, 0, 1e-14);
  const double expected = 2.0227 * 0.1 * std::sqrt(1 / 39.0);
  EXPECT_NEAR((result.high.B_mean - result.low.B_mean) / 2 / expected, 1, 0.05);
}

TEST(Intervals, HoldEachEstimateAndExistForAll)
{
  const auto data = neutral_data(0.1);
  const auto result = fit_rule(data, parse_rule("uniform:0.8"), {}, Bootstrap(data.runs, 300, 1));
  for (const auto& [name, place] : estimator_names) {
    EXPECT_LT(result.low.*place, result.value.*place) << name;
    EXPECT_GT(result.high.*place, result.value.*place) << name;
  }
  EXPECT_LT(result.minus_size_interval.low, result.minus_size);
  // The same samples for both rules: the difference is known better than either.
  EXPECT_LT(result.minus_size_interval.high - result.minus_size_interval.low,
            result.high.B_direct - result.low.B_direct);
}

TEST(Intervals, BLiesInTheIntervalOfItsSlope)
{
  const auto data = neutral_data(0.1);
  const auto result = fit_rule(data, {}, {}, Bootstrap(data.runs, 1000, 1));
  // dB_half/ds = -4/(1 + s)^2, so both intervals are one but for curvature.
  const double s = result.value.slope;
  EXPECT_NEAR((result.high.B_half - result.low.B_half) /
                  ((result.high.slope - result.low.slope) * 4 / ((1 + s) * (1 + s))),
              1, 0.01);
}

FitReport report_with_seed(unsigned long seed)
{
  const auto data = neutral_data(0.1);
  const Bootstrap bootstrap(data.runs, 200, seed);
  FitReport report;
  report.header = {{"program", "grseg-fit"}};
  report.inputs = {"run.h5 0123456789abcdef"};
  report.history = {"grseg-sim chute.ini", "grseg-stress run.h5"};
  for (const char* rule : {"size", "drop", "uniform:0.8"})
    report.rules.push_back(fit_rule(data, parse_rule(rule), {}, bootstrap));
  report.scan = scan_partition(data, parse_scan("0.5:0.8:0.1"), {}, bootstrap);
  return report;
}

TEST(FitReport, TheSameSeedGivesTheSameBytesAndAnotherSeedOthers)
{
  EXPECT_EQ(to_json(report_with_seed(3)), to_json(report_with_seed(3)));
  EXPECT_NE(to_json(report_with_seed(3)), to_json(report_with_seed(4)));
  EXPECT_EQ(to_tsv(report_with_seed(3)), to_tsv(report_with_seed(3)));
}

TEST(FitReport, JsonSaysNullWhereThereIsNoNumber)
{
  const auto report = report_with_seed(1);
  const auto json = nlohmann::json::parse(to_json(report));
  ASSERT_EQ(json["rules"].size(), 3u);
  const auto& size = json["rules"][0];
  for (const char* key : {"rule", "component", "quantity", "slope", "slope_interval", "exponent",
                          "B_half", "B_mean", "B_direct", "B_interval", "points", "estimators"})
    EXPECT_TRUE(size.contains(key)) << key;
  EXPECT_EQ(size["rule"], "size");
  EXPECT_EQ(size["points"], 210);
  EXPECT_EQ(size["B_half"], report.rules[0].value.B_half);
  EXPECT_EQ(size["B_interval"][0], report.rules[0].low.B_half);
  EXPECT_EQ(size["estimators"]["B_direct"]["interval"][1], report.rules[0].high.B_direct);
  EXPECT_TRUE(json["rules"][1]["B_half"].is_null());
  EXPECT_TRUE(json["rules"][1]["B_interval"][0].is_null());
  EXPECT_TRUE(json["rules"][1]["slope"].is_number());
  EXPECT_EQ(json["scan"].size(), 4u);
  EXPECT_EQ(json["scan"][1][0], 0.6);
  EXPECT_EQ(json["scan"][1][1], report.scan->fits[1].value.B_half);
  EXPECT_EQ(json["p_zero"], report.scan->p_zero);
  EXPECT_EQ(json["dB_dp"], report.scan->dB_dp);
  EXPECT_EQ(json["inputs"][0], "run.h5 0123456789abcdef");
  EXPECT_EQ(json["history"].size(), 2u);
}

TEST(FitReport, TheTableNamesTheRuleFirstAndTheScanIsATable)
{
  auto report = report_with_seed(1);
  const auto scan = Table::parse(to_tsv(report), "scan");
  ASSERT_EQ(scan.rows.size(), 4u);
  EXPECT_EQ(scan.rows[3][scan.column("B")], report.scan->fits[3].value.B_half);
  EXPECT_EQ(scan.header_number("p_zero"), report.scan->p_zero);
  report.scan.reset();
  const auto text = to_tsv(report);
  EXPECT_TRUE(holds(text, "\nrule\tpoints\tslope\tslope_low\tslope_high\t"));
  EXPECT_TRUE(holds(text, "\nsize\t210\t"));
  EXPECT_TRUE(holds(text, "\nuniform:0.8\t210\t"));
  EXPECT_TRUE(holds(text, "# history: grseg-sim chute.ini\n# history: grseg-stress run.h5\n"));
}

}  // namespace
}  // namespace grseg
