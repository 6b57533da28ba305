// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/mixtures.hpp"

#include "analysis/fit/fit_mixtures.hpp"
#include "analysis/fit/run_errors.hpp"
#include "analysis/fit/size_exponent.hpp"
#include "formats/core/errors.hpp"
#include "tests/analysis/correlated_windows.hpp"
#include "tests/analysis/synthetic_fits.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace grseg {
namespace {

using synthetic::neutral_sums;
using synthetic::stress_table;
using synthetic::TableRow;

/// A run of two windows and one layer, of this composition.
Table run_of(double phi_large, const std::string& gravity = "3.83", double scatter = 0)
{
  auto table = stress_table({{0, 1, 10, neutral_sums(phi_large, 2 + scatter)},
                             {1, 2, 10, neutral_sums(phi_large, 2 - scatter / 2)}});
  table.header.emplace_back("gravity_x", gravity);
  table.header.emplace_back("gravity_y", "-9.02");
  return table;
}

std::vector<FitTable> read_all(const std::vector<Table>& tables)
{
  return read_fit_tables(tables, Quantity::contact, {{}});
}

using Numbers = std::vector<std::size_t>;

TEST(Mixtures, TablesThatDifferInTheirSeedAloneAreRunsOfOne)
{
  const std::vector<Table> tables{run_of(0.45), run_of(0.301), run_of(0.3), run_of(0.452)};
  auto read = read_all(tables);
  const auto mixtures = find_mixtures(read, "auto");
  ASSERT_EQ(mixtures.size(), 2u);
  EXPECT_EQ(mixtures[0].tables, (Numbers{1, 2}));
  EXPECT_EQ(mixtures[1].tables, (Numbers{0, 3}));
  EXPECT_EQ(mixtures[0].name, "Phi_L = 0.30");
  EXPECT_NEAR(mixtures[1].phi_large(), 0.45, 1e-12);
  EXPECT_EQ(read[3].mixture, 1u);
}

TEST(Mixtures, AreToldApartByAllThatTablesRecordOfTheFlow)
{
  const std::vector<Table> tables{run_of(0.3), run_of(0.301, "4.3"), run_of(0.302, "3.8300001")};
  auto read = read_all(tables);
  const auto mixtures = find_mixtures(read, "auto");
  ASSERT_EQ(mixtures.size(), 2u);
  EXPECT_EQ(mixtures[0].tables, (Numbers{0, 2}));
  EXPECT_EQ(mixtures[0].name, "Phi_L = 0.30, gravity_x = 3.83");
  EXPECT_EQ(mixtures[1].name, "Phi_L = 0.30, gravity_x = 4.3");
}

// Of spheres the cell has a width, too. What only one of two tables records tells them apart as well.
TEST(Mixtures, AreToldApartByTheirMaterialAndTheWidthOfTheCell)
{
  int runs = 0;
  const auto with = [&runs](std::vector<HeaderLine> lines) {
    auto table = run_of(0.3 + 1e-4 * runs++ / 100);
    table.header.insert(table.header.end(), lines.begin(), lines.end());
    return table;
  };
  for (const char* key : {"density", "friction", "restitution", "length_z"}) {
    const std::vector<Table> tables{with({{key, "0.3"}}), with({{key, "0.8"}}), with({}),
                                    with({{key, "0.3"}}), with({{key, "unknown"}})};
    auto read = read_all(tables);
    const auto mixtures = find_mixtures(read, "auto");
    ASSERT_EQ(mixtures.size(), 3u) << key;
    EXPECT_EQ(mixtures[0].tables, (Numbers{0, 3}));
    EXPECT_EQ(mixtures[0].name, std::string("Phi_L = 0.30, ") + key + " = 0.3");
    EXPECT_EQ(mixtures[2].name, std::string("Phi_L = 0.30, ") + key + " = unknown");
    EXPECT_EQ(mixtures[2].tables, (Numbers{2, 4}));
  }
}

TEST(Mixtures, TheWordsNameWhatTheTablesRecord)
{
  EXPECT_EQ(
      grouping_words("auto", {run_of(0.3)}),
      "runs of one mixture agree in what their tables record of the flow (diameters, gravity), "
      "diameters to 1 %, and in overall composition, to 0.02");
  auto with_friction = run_of(0.3);
  with_friction.header.insert(with_friction.header.end(),
                              {{"density", "unknown"}, {"friction", "0.5"}});
  EXPECT_NE(
      grouping_words("auto", {run_of(0.3), with_friction}).find("(diameters, friction, gravity)"),
      std::string::npos);
}

// Nominal diameters of imported runs are measured on their grains, which differ from seed to seed.
TEST(Mixtures, DiametersMeasuredOnTheGrainsOfSeedsAreThoseOfOne)
{
  int runs = 0;
  const auto with = [&runs](const char* large, const char* species) {
    auto table = run_of(0.3 + 1e-6 * runs++);
    for (auto& [key, value] : table.header)
      if (key == "large_diameter") value = large;
    table.header.emplace_back("species", species);
    return table;
  };
  const std::vector<Table> tables{
      with("0.01", "S 0.005, L 0.01"), with("0.009997", "S 0.005, L 0.009997"),
      with("0.0098", "S 0.005, L 0.0098"), with("0.01", "S 0.005, X 0.01")};
  auto read = read_all(tables);
  const auto mixtures = find_mixtures(read, "auto");
  ASSERT_EQ(mixtures.size(), 3u);
  EXPECT_EQ(mixtures[0].tables, (Numbers{0, 1}));
}

// What begins with the same number need not be the same.
TEST(Mixtures, AListIsNotItsFirstNumber)
{
  std::vector<Table> tables{run_of(0.3), run_of(0.3001)};
  tables[0].header.emplace_back("friction", "0.5, 0.3");
  tables[1].header.emplace_back("friction", "0.5, 0.4");
  auto read = read_all(tables);
  EXPECT_EQ(find_mixtures(read, "auto").size(), 2u);
}

TEST(Mixtures, OrAsTheUserSays)
{
  const std::vector<Table> tables{run_of(0.3), run_of(0.301), run_of(0.5)};
  auto read = read_all(tables);
  const auto mixtures = find_mixtures(read, "1,2");
  ASSERT_EQ(mixtures.size(), 2u);
  EXPECT_EQ(mixtures[1].tables, (Numbers{1, 2}));
  for (const char* wrong : {"2", "4", "1,2,0", "", "1,-1", "x", "1;2", "99999999999999999999"})
    EXPECT_THROW(find_mixtures(read, wrong), UsageError) << wrong;
}

TEST(Mixtures, ThePartOfOneIsWhatItsTablesGiveAlone)
{
  const std::vector<Table> tables{run_of(0.3, "1", 0.2), run_of(0.5, "1", 0.4),
                                  run_of(0.31, "1", -0.1)};
  auto read = read_all(tables);
  find_mixtures(read, "auto");
  const auto both = select_fit_data(read, Quantity::contact, {}, {{0, 1}});
  const auto alone = select_fit_data({read[0], read[2]}, Quantity::contact, {}, {{0, 1}});
  const auto part = of_mixture(both, 0);
  EXPECT_EQ(part.runs, alone.runs);
  EXPECT_EQ(part.rows.size(), alone.rows.size());
  const PartitionRule half = parse_rule("half");
  EXPECT_EQ(fit_rule(part, half, {}, {part.runs, 0, 1}).value.B_half,
            fit_rule(alone, half, {}, {alone.runs, 0, 1}).value.B_half);
  const auto shares = weight_shares(both, 2).half;
  // The rarer species are large grains: 0.3, 0.5 and 0.31 of the same area, each in two windows.
  EXPECT_NEAR(shares[0], 0.61 / 1.11, 1e-12);
  EXPECT_NEAR(shares[1], 0.5 / 1.11, 1e-12);
  const double products = 0.3 * 0.7 + 0.31 * 0.69;
  EXPECT_NEAR(weight_shares(both, 2).sums[0], products / (products + 0.25), 1e-12);
}

/// Runs of one window and one layer, each with its own -ln s, that of its mixture plus -d, 0, d.
struct Flow {
  double b, d, weight;
};
FitData three_runs_of_each(const std::vector<Flow>& flows)
{
  FitData data;
  data.quantity = Quantity::kinetic;
  data.tables = {"runs.tsv"};
  for (std::size_t mixture = 0; mixture < flows.size(); ++mixture)
    for (const double step : {-1, 0, 1}) {
      const auto& flow = flows[mixture];
      const double slope = std::exp(-flow.b - step * flow.d);
      ContactSums<3> sums;
      sums.volume = 1;
      sums.of(OwnSum::inside, 0)(1, 1) = slope;
      sums.of(OwnSum::inside, 1)(1, 1) = 1;
      data.samples.push_back({.window = data.runs.size(),
                              .phi_large = 0.5,
                              .weight = flow.weight,
                              .size_ratio = 2,
                              .row = data.rows.size()});
      data.rows.push_back(sums);
      data.runs.push_back(1);
      data.mixtures.push_back(mixture);
    }
  return data;
}

RuleFit fit_over(const FitData& data, Over over)
{
  return fit_mixtures(data, {}, {.over = over}, {200, 1}).all;
}

double reach(const RuleFit& fit)
{
  return (fit.high.B_mean - fit.low.B_mean) / 2;
}

// Three runs -d, 0, d about their mixture: the standard error of its mean is d/sqrt(3), with two
// degrees of freedom. B_mean = -ln s is linear in the runs.
TEST(Populations, OfOneMixtureAreItsRuns)
{
  const auto fit = fit_over(three_runs_of_each({{0.04, 0.003, 2}}), Over::automatic);
  EXPECT_EQ(fit.over, Over::runs);
  EXPECT_NEAR(fit.value.B_mean, 0.04, 1e-15);
  EXPECT_NEAR(reach(fit), gsl_cdf_tdist_Pinv(0.975, 2) * 0.003 / std::sqrt(3), 1e-10);
  EXPECT_NEAR(fit.degrees, 2, 1e-12);
  EXPECT_NEAR(fit.at(Over::runs).low, fit.low.B_half, 1e-15);
}

TEST(Populations, MixturesAsTheyAreCountByTheirWeights)
{
  const auto fit =
      fit_over(three_runs_of_each({{0.03, 0.003, 1}, {0.05, 0.001, 3}}), Over::automatic);
  EXPECT_EQ(fit.over, Over::mixtures);
  EXPECT_NEAR(fit.value.B_mean, (0.03 + 3 * 0.05) / 4, 1e-15);
  // Both mixtures contribute the same error: 0.003/4 and 3 x 0.001/4, over sqrt(3).
  const double error = std::sqrt(2.0 / 3) * 0.003 / 4;
  EXPECT_NEAR(reach(fit), gsl_cdf_tdist_Pinv(0.975, 4) * error, 1e-10);
}

TEST(Populations, EqualMixturesAreTheMeanOfTheirBs)
{
  const auto data = three_runs_of_each({{0.03, 0.003, 1}, {0.05, 0.001, 3}, {0.07, 0.002, 9}});
  const auto fit = fit_over(data, Over::equal_mixtures);
  EXPECT_NEAR(fit.value.B_mean, 0.05, 1e-15);
  // Squares of 0.003, 0.001 and 0.002 over 27, with two degrees of freedom each.
  const double sum = 14e-6, fourths = (81e-12 + 1e-12 + 16e-12) / (2 + 2);
  const double degrees = sum * sum / fourths - 2;
  EXPECT_NEAR(reach(fit), gsl_cdf_tdist_Pinv(0.975, degrees) * std::sqrt(sum / 27), 1e-10);
  EXPECT_NEAR(fit.degrees, degrees, 0.01);  // those of B_half, which is not quite linear
  // How mixtures differ is not in it.
  const auto apart = three_runs_of_each({{-0.53, 0.003, 1}, {0.05, 0.001, 3}, {0.63, 0.002, 9}});
  EXPECT_NEAR(reach(fit_over(apart, Over::equal_mixtures)), reach(fit), 1e-10);
}

/// Two mixtures, of two runs each, that scatter by `scatter`; large grains are twice as large.
FitData four_runs(double scatter)
{
  const std::vector<Table> tables{run_of(0.3, "1", scatter), run_of(0.3, "1", 2 * scatter),
                                  run_of(0.6, "1", -scatter), run_of(0.6, "1", 3 * scatter)};
  auto read = read_all(tables);
  find_mixtures(read, "auto");
  return select_fit_data(read, Quantity::contact, {}, {{0, 1}});
}

// Beside B_direct stands how far it is from that by size: with either each mixture counts the same.
TEST(Populations, AllNumbersOfARowAreOfTheSameOnes)
{
  const auto data = four_runs(0.2);
  for (const auto over : {Over::equal_mixtures, Over::random_mixtures}) {
    const auto fits = fit_mixtures(data, parse_rule("half"), {.over = over}, {200, 1});
    const auto &half = fits.all, &first = fits.of_each.at(0), &second = fits.of_each.at(1);
    const auto size = fit_over(data, over);
    EXPECT_NEAR(half.minus_size.value, half.value.B_direct - size.value.B_direct, 1e-14);
    EXPECT_LT(half.minus_size.interval().low, half.minus_size.value);
    EXPECT_NEAR(half.neutral, (first.neutral + second.neutral) / 2, 1e-15);
    EXPECT_NEAR(half.share, 0.5, 1e-14);
    const auto a = size_exponent(data, parse_rule("half"), {.over = over}, {200, 1});
    EXPECT_NEAR(a.value, half.value.B_mean / std::log(2), 1e-13);
    EXPECT_NEAR(a.low, half.low.B_mean / std::log(2), 1e-9 * (a.high - a.low));
    for (const auto& pooled : {half.B_half_windows, half.B_sums_windows})
      EXPECT_TRUE(std::isnan(pooled.low));
  }
}

// Errors of the difference half - size of two mixtures of which each is known add up: 1/2 of the root of
// the sum of their squares.
TEST(Populations, TheDifferenceToSizeHasTheErrorsOfTheMixturesDifferences)
{
  const auto fits =
      fit_mixtures(four_runs(0.2), parse_rule("half"), {.over = Over::equal_mixtures}, {200, 1});
  const double sum = std::hypot(fits.of_each.at(0).minus_size.error.error,
                                fits.of_each.at(1).minus_size.error.error);
  EXPECT_GT(sum, 0);
  EXPECT_NEAR(fits.all.minus_size.error.error, sum / 2, 1e-15);
}

// Whatever the intervals of all are over, mixtures are known as well as their runs tell.
TEST(Populations, EqualMixturesAreByTheirRunsAlsoBesideIntervalsOverWindows)
{
  synthetic::RunsOfMixtures source({3, 4, 2, 3});
  const auto data = source.draw().data;
  const auto by_windows = fit_over(data, Over::windows), by_runs = fit_over(data, Over::mixtures);
  ASSERT_TRUE(std::isfinite(by_runs.at(Over::equal_mixtures).low));
  EXPECT_EQ(by_windows.at(Over::equal_mixtures).low, by_runs.at(Over::equal_mixtures).low);
  EXPECT_EQ(by_windows.sums_at(Over::equal_mixtures).high,
            by_runs.sums_at(Over::equal_mixtures).high);
}

// Student's interval of the mean of 0.03, 0.05 and 0.07.
TEST(Populations, RandomMixturesScatterLikeTheirBs)
{
  const auto data = three_runs_of_each({{0.03, 0.003, 1}, {0.05, 0.001, 3}, {0.07, 0.002, 9}});
  const auto fit = fit_over(data, Over::random_mixtures);
  EXPECT_NEAR(fit.value.B_mean, 0.05, 1e-15);
  EXPECT_NEAR(reach(fit), gsl_cdf_tdist_Pinv(0.975, 2) * 0.02 / std::sqrt(3), 1e-12);
  EXPECT_NE(fit.doubt.find("3 mixtures tell little of how mixtures differ"), std::string::npos);
  EXPECT_TRUE(std::isfinite(fit.at(Over::equal_mixtures).low));
  EXPECT_NEAR(fit.at(Over::mixtures).value, fit_over(data, Over::mixtures).value.B_half, 1e-15);
}

/// Shares of trials in which an interval of B_half and of B_sums holds a number.
struct Held {
  int trials = 0, half = 0, sums = 0;

  void add(const Estimate& of_half, double half_truth, const Estimate& of_sums, double sums_truth)
  {
    ++trials;
    half += of_half.low <= half_truth && half_truth <= of_half.high;
    sums += of_sums.low <= sums_truth && sums_truth <= of_sums.high;
  }
  double share(int held) const { return static_cast<double>(held) / trials; }
  /// 95 % as far as so many trials can tell: 3.5 standard deviations of a binomial share.
  void expect_95_percent(const char* what) const
  {
    const double reach = 3.5 * std::sqrt(0.95 * 0.05 / trials);
    EXPECT_NEAR(share(half), 0.95, reach) << "B_half over " << what;
    EXPECT_NEAR(share(sums), 0.95, reach) << "B_sums over " << what;
  }
};

// Mixtures that differ by twice the error of one, runs by as much as their windows make them.
TEST(Coverage, OfEachPopulationIsThatOfItsOwnNumberAndNotOfAnother)
{
  synthetic::RunsOfMixtures source({6, 4, 2, 1});
  Held windows, runs, mixtures, equal, random, equal_for_all;
  for (unsigned long trial = 1; trial <= 300; ++trial) {
    const auto drawn = source.draw();
    const auto fits = fit_mixtures(drawn.data, {}, {}, {100, trial});
    const auto &half = drawn.half, &sums = drawn.sums;
    const auto add = [&all = fits.all](Held& held, Over over, double of_half, double of_sums) {
      held.add(all.at(over), of_half, all.sums_at(over), of_sums);
    };
    add(windows, Over::windows, half.of_runs, sums.of_runs);
    add(mixtures, Over::mixtures, half.of_mixtures, sums.of_mixtures);
    add(equal, Over::equal_mixtures, half.of_equal, sums.of_equal);
    add(random, Over::random_mixtures, half.of_all, sums.of_all);
    add(equal_for_all, Over::equal_mixtures, half.of_all, sums.of_all);
    for (std::size_t m = 0; m < fits.of_each.size(); ++m)
      runs.add(fits.of_each[m].at(Over::runs), half.of_each[m], fits.of_each[m].sums_at(Over::runs),
               sums.of_each[m]);
  }
  windows.expect_95_percent("windows");
  runs.expect_95_percent("runs");
  mixtures.expect_95_percent("mixtures");
  equal.expect_95_percent("equal mixtures");
  random.expect_95_percent("random mixtures");
  // The mean of six is off by twice the error of one over sqrt(6), its own error by the root of 5 less:
  // it holds the mean of all with the chance of |Z| < 2.1/sqrt(5).
  EXPECT_LT(equal_for_all.share(equal_for_all.half), 0.8);
}

TEST(Coverage, OfTwoRunsOfEachMixtureIsThatOfMore)
{
  synthetic::RunsOfMixtures source({6, 2, 0, 0});
  Held mixtures, equal;
  for (unsigned long trial = 1; trial <= 300; ++trial) {
    const auto drawn = source.draw();
    const auto all = fit_mixtures(drawn.data, {}, {}, {100, trial}).all;
    mixtures.add(all.at(Over::mixtures), drawn.half.of_mixtures, all.sums_at(Over::mixtures),
                 drawn.sums.of_mixtures);
    equal.add(all.at(Over::equal_mixtures), drawn.half.of_equal, all.sums_at(Over::equal_mixtures),
              drawn.sums.of_equal);
  }
  mixtures.expect_95_percent("mixtures");
  equal.expect_95_percent("equal mixtures");
}

/// In how many of so many trials the doubt is voiced that one function of composition is not enough.
int doubts_of_one_function(double mixture_scatter, unsigned long trials)
{
  synthetic::RunsOfMixtures source({6, 4, mixture_scatter, 1});
  int doubts = 0;
  for (unsigned long trial = 1; trial <= trials; ++trial) {
    const auto data = source.draw().data;
    const auto fit =
        fit_rule(data, {}, {.over = Over::compositions}, Bootstrap(data.runs, 100, trial));
    doubts += fit.doubt.starts_with("mixtures differ by more");
  }
  return doubts;
}

// Fisher's test at 5 %: more often it is not wrong, and mixtures that differ by four times the error
// of one, for which the ratio of mean squares is 17 on average, it misses in few of a hundred.
TEST(Populations, OneFunctionOfCompositionIsDoubtedWhereMixturesDiffer)
{
  constexpr double by_chance = 0.05 * 200;
  EXPECT_LT(doubts_of_one_function(0, 200), by_chance + 3.5 * std::sqrt(by_chance * 0.95));
  EXPECT_GT(doubts_of_one_function(4, 100), 90);
}

// A single run does not tell how runs differ; what its windows tell is an interval with a doubt, or
// none where they are too few for their correlation, as ten of rho = 1/2 often are.
TEST(Populations, WindowsStandForRunsOfAMixtureThatHasOne)
{
  synthetic::RunsOfMixtures source({2, 1, 0, 0});
  int with_interval = 0;
  for (unsigned long trial = 1; trial <= 30; ++trial) {
    const auto fits = fit_mixtures(source.draw().data, {}, {}, {100, trial});
    ASSERT_EQ(fits.of_each.size(), 2u);
    EXPECT_EQ(fits.of_each[0].over, Over::windows);
    EXPECT_EQ(fits.all.over, Over::mixtures);
    EXPECT_TRUE(fits.all.doubt.starts_with("2 of 2 mixtures have one run")) << fits.all.doubt;
    with_interval += fits.all.low.B_half < fits.all.value.B_half;
  }
  EXPECT_GT(with_interval, 0);
  EXPECT_LT(with_interval, 30);
}

// Windows of a single run that differ among themselves by +-1; that all of them are off by 7, since the
// mixture is, is no scatter. Nor is it in proportion to unequal weights. Eight values +-1/8 in an order
// without correlation have the error of their mean, sqrt(8/7)/sqrt(8), with seven degrees of freedom.
TEST(Populations, OfASingleRunHowItsMixtureDiffersIsNoScatterOfItsWindows)
{
  FitData data;
  data.runs = {8};
  data.mixtures = {0};
  Eigen::VectorXd scatter(8), weight = Eigen::VectorXd::Ones(8);
  scatter << 1, -1, 1, 1, -1, -1, -1, 1;
  const auto error_of = [&](const Eigen::VectorXd& noise) {
    return RunErrors(data, weight).within_mixtures(noise, noise);
  };
  const auto alone = error_of(scatter / 8), shifted = error_of((scatter.array() + 7) / 8);
  EXPECT_NEAR(alone.error, std::sqrt(1. / 7), 1e-14);
  EXPECT_NEAR(alone.degrees, 7, 1e-12);
  EXPECT_NEAR(shifted.error, alone.error, 1e-13);
  EXPECT_NEAR(shifted.degrees, alone.degrees, 1e-12);
  weight << 1, 2, 3, 4, 4, 3, 2, 1;
  EXPECT_NEAR(error_of(0.3 * weight).error, 0, 1e-15);
}

// Two runs of each of four mixtures; their values are -3, -1, 1, 3 times `apart`, plus and minus 1 within
// a mixture: mean squares 2 x 20 apart^2/f between and 8/4 within. Where composition has taken two of the
// three degrees, one is left, and Fisher's quantile of 5 % with 1 and 4 degrees is 7.7086, not 6.5914.
TEST(Populations, FishersTestCountsTheDegreesThatCompositionHasTaken)
{
  FitData data;
  data.runs = RunLengths(8, 1);
  data.mixtures = {0, 0, 1, 1, 2, 2, 3, 3};
  const RunErrors errors(data, Eigen::VectorXd::Ones(8));
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

// B = 0.1 in the even layer and 0 where large grains are few, in 40 windows that hardly scatter: with
// weights 0.5 and 0.1 of B_half, 0.25 and 0.09 of B_sums the two differ without any bias.
TEST(Populations, ThatBHalfAndBSumsDifferMayBeDueToThoseTheyWeigh)
{
  std::vector<TableRow> rows;
  for (int k = 0; k < 40; ++k)
    for (const auto& [phi, b] : {std::pair{0.5, 0.1}, {0.1, 0.0}}) {
      const double psi = phi * (1 + b * (1 - phi)) + 1e-6 * synthetic::scatter(rows.size());
      rows.push_back({1.0 * k, k + 1.0, 10,
                      synthetic::separate_sums(phi, (1 - psi) * synthetic::any_tensor(),
                                               psi * synthetic::any_tensor())});
    }
  const auto data = synthetic::read({stress_table(rows)});
  const auto fit = fit_rule(data, {}, {}, Bootstrap(data.runs, 200, 1));
  EXPECT_NE(
      fit.doubt.find("suffers from few grains, or B differs between layers or mixtures, which "
                     "the two weigh differently"),
      std::string::npos)
      << fit.doubt;
}

TEST(Populations, EachIsNamedInWordsWithItsWeights)
{
  EXPECT_NE(
      estimand_words(Over::mixtures, 6)
          .find("these 6 mixtures, weighted as they are (B_half by frames x grains of the rarer "
                "species, B_sums by frames x phi_L phi_S)"),
      std::string::npos);
  EXPECT_NE(estimand_words(Over::equal_mixtures, 6).find("each counting the same"),
            std::string::npos);
  for (const auto& [word, over, meaning] : overs)
    EXPECT_GT(estimand_words(over, 2).size(), 40u) << word;
}

}  // namespace
}  // namespace grseg
