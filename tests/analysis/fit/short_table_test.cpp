// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_report.hpp"
#include "analysis/frames/sums.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace grseg {
namespace {

/// A fit with these results.
RuleFit fit(const PartitionRule& rule, const Estimate& b, double share)
{
  RuleFit fit;
  fit.rule = rule;
  fit.value.B = b.value;
  fit.low.B = b.low;
  fit.high.B = b.high;
  fit.share = share;
  return fit;
}

FitReport report()
{
  FitReport report;
  report.rules = {
      fit({PartitionRule::Kind::size}, {0.03449, 0.0295, 0.0394999}, 0.66651),
      fit({PartitionRule::Kind::half}, {-0.31451, -0.3205, -0.3095}, 0.5),
      fit({PartitionRule::Kind::drop}, {}, no_number),
      fit({PartitionRule::Kind::uniform, 0.65}, {-0.0004}, 0.65),
  };
  report.rules[0].line = {{0.6481, {0.001 / 3.182446, 3}}, {2.0996}};  // -+ 0.001
  report.number_of_runs = 2;
  report.number_of_windows = 1;
  return report;
}

void expect_line(const FitReport& of, const std::string& line)
{
  const auto text = short_table(of);
  EXPECT_NE(text.find('\n' + line + '\n'), std::string::npos) << line << "\n\n" << text;
}

// Rounded by hand, half away from the digit: 0.03449 -> 0.034, 0.0394999 -> 0.039, -0.0004 -> 0.
TEST(ShortTable, RoundsToThreeDecimalsAndLeavesADashWhereThereIsNoNumber)
{
  const auto text = short_table(report());
  EXPECT_TRUE(
      text.starts_with("B of the contact stress (yy), a mean with the weight phi_L phi_S, from "
                       "1 window of 2 runs\n\n"))
      << text;
  expect_line(report(), "rule                         B [95 %]  share  used by");
  expect_line(report(),
              "size             0.034 [0.029, 0.039]  0.667  grseg, Staron & Phillips 2015");
  expect_line(report(), "uniform:0.65                    0.000  0.650  -");
  EXPECT_NE(text.find("\nhalf          -0.315 [-0.321, -0.309]  0.500  LAMMPS, "),
            std::string::npos);
  EXPECT_NE(text.find("\ndrop                                -      -  sums over "),
            std::string::npos);
  expect_line(report(),
              "B = 0 if the large grain gets p* = 0.648 [0.647, 0.649] of every mixed contact; "
              "dB/dp = 2.100");
}

TEST(ShortTable, OfRulesAndFitsFitsAHundredColumns)
{
  auto stock = report();
  for (const auto& rule : parse_rules({"stock"}))
    stock.rules.push_back(fit(rule, {-0.31451, -0.3205, -0.3095}, 0.5));
  std::istringstream lines(short_table(stock));
  int number = 0;
  for (std::string line; std::getline(lines, line) && number < 12; ++number)
    EXPECT_LE(line.size(), 100u) << line;
  EXPECT_EQ(number, 12);
}

TEST(ShortTable, WhatThePaperFitsStandsBesideOnRequest)
{
  auto both = report();
  both.rules.resize(1);
  EXPECT_EQ(short_table(both).find("paper fits"), std::string::npos);
  both.with_paper = true;
  both.rules[0].value.paper_s = 0.966;
  both.rules[0].low.paper_s = 0.95;
  both.rules[0].high.paper_s = 0.98;
  expect_line(both, "as the paper fits              s [95 %]  B of s [95 %]  k [95 %]  a [95 %]");
  expect_line(both, "size               0.966 [0.950, 0.980]              -         -  -");
}

TEST(ShortTable, EndsWithTheDoubts)
{
  auto doubtful = report();
  doubtful.rules.resize(1);
  doubtful.rules[0].doubt = "2 runs tell little of how runs differ";
  const auto text = short_table(doubtful);
  EXPECT_TRUE(text.ends_with("\n\ndoubt: size: 2 runs tell little of how runs differ\n")) << text;
}

TEST(ShortTable, StatesADoubtOnceWithAllRulesThatItIsAbout)
{
  auto doubtful = report();
  for (auto& fit : doubtful.rules) fit.doubt = "few windows";
  const auto text = short_table(doubtful);
  const auto first = text.find("few windows");
  EXPECT_NE(text.find("doubt: size, half"), std::string::npos) << text;
  EXPECT_EQ(text.find("few windows", first + 1), std::string::npos) << text;
}

TEST(ShortTable, SaysOverWhatItsIntervalsAreAndNothingOfOthers)
{
  auto of_runs = report();
  of_runs.flows = {{"Phi_L = 0.30", {0.7, 0.3}, {0, 1}}};
  of_runs.shares = {1};
  for (auto& fit : of_runs.rules) fit.over = Population::runs;
  for (const auto over : {Population::windows, Population::runs})
    of_runs.rules[0].at(over) = {0.03, 0.02, 0.04};
  const auto text = short_table(of_runs);
  EXPECT_NE(text.find("\nintervals over runs: B of one flow"), std::string::npos) << text;
  EXPECT_EQ(text.find("over windows"), std::string::npos) << text;
}

/// A report whose p* has this interval.
FitReport with_zero(double low, double high)
{
  auto of = report();
  for (auto& fit : of.rules) fit.line.p_zero = {(low + high) / 2, {(high - low) / 2 / 3.182446, 3}};
  return of;
}

TEST(ShortTable, DoubtsAZeroWhoseIntervalLeavesTheSharesThatRulesHave)
{
  const auto doubts_of = [](double low, double high) { return doubts(with_zero(low, high)); };
  EXPECT_TRUE(doubts_of(0.01, 0.99).empty());
  const std::string leaves =
      "the interval of p*, [-2.9, 3.8], reaches beyond 0 to 1, where the "
      "shares of all rules lie: these data do not determine p*";
  EXPECT_EQ(doubts_of(-2.9, 3.8), std::vector{leaves});
  EXPECT_EQ(doubts_of(0.5, 1.2).size(), 1U);
  EXPECT_EQ(doubts_of(-0.1, 0.4).size(), 1U);
  for (const auto& [low, high] : {std::pair{1.1, 1.3}, {-0.4, -0.2}})
    EXPECT_NE(doubts_of(low, high)[0].find("lies outside 0 to 1: no rule"), std::string::npos);
}

TEST(ShortTable, KineticStressHasNoRuleAndNoZero)
{
  auto kinetic = report();
  kinetic.quantity = Quantity::kinetic;
  kinetic.rules = {fit({}, {-0.3731, -0.38, -0.366}, no_number)};
  const auto text = short_table(kinetic);
  EXPECT_TRUE(text.ends_with("kinetic  -0.373 [-0.380, -0.366]      -  -\n")) << text;
}

TEST(ShortTable, SaysOverWhatTheIntervalsOfAFlowAndOfAllFlowsAre)
{
  auto of_two = report();
  of_two.flows.resize(2);
  of_two.rules.resize(2);
  of_two.rules[0].flow = 0;
  of_two.rules[1].over = Population::flows;
  expect_line(of_two, "intervals of one flow are over windows, of all over flows");
}

TEST(ShortTable, CountsTheTablesOfEachFlow)
{
  auto of_two = report();
  of_two.flows = {{"Phi_L = 0.30", {0.7, 0.3}, {0, 2}}, {"Phi_L = 0.60", {0.4, 0.6}, {1}}};
  of_two.shares = {0.25, 0.75};
  expect_line(of_two, "Phi_L = 0.30: 2 tables, 25 % of the weight");
  expect_line(of_two, "Phi_L = 0.60: 1 table, 75 % of the weight");
}

}  // namespace
}  // namespace grseg
