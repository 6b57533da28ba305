// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/short_table.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

/// A fit with these numbers, whatever they would come from.
RuleFit fit(const PartitionRule& rule, double b, double low, double high, double share,
            std::size_t points)
{
  RuleFit fit;
  fit.rule = rule;
  fit.value.B_half = b;
  fit.low.B_half = low;
  fit.high.B_half = high;
  fit.share = share;
  fit.points = points;
  return fit;
}

FitReport report()
{
  constexpr double nan = Estimators::nan;
  FitReport report;
  report.rules = {
      fit({PartitionRule::Kind::size}, 0.03449, 0.0295, 0.0394999, 0.66651, 320),
      fit({PartitionRule::Kind::half}, -0.31451, -0.3205, -0.3095, 0.5, 320),
      fit({PartitionRule::Kind::drop}, nan, nan, nan, nan, 7),
      fit({PartitionRule::Kind::uniform, 0.65}, -0.0004, nan, nan, 0.65, 320),
  };
  report.rules[0].value.B_sums = 0.0411;
  report.rules[0].low.B_sums = 0.0401;
  report.rules[0].high.B_sums = 0.0421;
  report.rules[0].p_zero_sums = {0.6481, {0.001 / 3.182446, 3}};  // -+ 0.001
  report.number_of_runs = 2;
  report.number_of_windows = 1;
  ZeroOfB zero;
  zero.p_zero = 0.65049;
  zero.p_zero_interval = {0.6485, 0.65251};
  zero.dB_dp = 2.0996;
  report.zero = zero;
  return report;
}

// Rounded by hand, half away from the digit: 0.03449 -> 0.034, 0.0394999 -> 0.039, -0.0004 -> 0.
TEST(ShortTable, RoundsToThreeDecimalsAndLeavesADashWhereThereIsNoNumber)
{
  const auto text = short_table(report());
  const auto has = [&](const char* line) {
    EXPECT_NE(text.find(line), std::string::npos) << line << '\n' << text;
  };
  EXPECT_TRUE(text.starts_with(
      "B of the contact stress (yy), B_half: at phi_L = 1/2, B_sums: mean with weight phi_L phi_S, "
      "from 1 window of 2 runs\n\n"))
      << text;
  has("\nrule          B_half     95 % interval  B_sums     95 % interval  share  points  used by\n");
  has("\nsize           0.034   0.029 to  0.039   0.041   0.040 to  0.042  0.667     320  grseg, Staron "
      "& Phillips 2015\n");
  has("\nhalf          -0.315  -0.321 to -0.309       -                 -  0.500     320  LAMMPS, ");
  has("\ndrop               -                 -       -                 -      -       7  sums over ");
  has("\nuniform:0.65   0.000                 -       -                 -  0.650     320  -\n");
  has("\np* = 0.650 (0.648 to 0.653): with this share of every mixed contact B = 0; dB/dp = 2.100 "
      "there\n");
  has("\np* by sums = 0.648 (0.647 to 0.649): with this share B_sums = 0\n");
}

TEST(ShortTable, BOfThePressureStandsBesideThatOfYy)
{
  auto both = report();
  both.rules.resize(2);
  both.rules[0].B_pressure = {0.0412, 0.0388, 0.0436};
  const auto text = short_table(both);
  EXPECT_NE(text.find("  B_half, pressure     95 % interval  share"), std::string::npos) << text;
  EXPECT_NE(text.find("             0.041   0.039 to  0.044  0.667"), std::string::npos) << text;
  EXPECT_NE(text.find("                 -                 -  0.500"), std::string::npos) << text;
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

TEST(ShortTable, KineticStressHasNoRuleAndNoZero)
{
  auto kinetic = report();
  kinetic.quantity = Quantity::kinetic;
  kinetic.rules = {fit({}, -0.3731, -0.38, -0.366, Estimators::nan, 300)};
  kinetic.zero.reset();
  const auto text = short_table(kinetic);
  EXPECT_NE(text.find("\nkinetic  -0.373  -0.380 to -0.366"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("-     300  -\n")) << text;
}

TEST(ShortTable, AScanIsSummedUpByItsEnds)
{
  auto scanned = report();
  scanned.zero.reset();
  PartitionScan scan;
  scan.fits = {fit({PartitionRule::Kind::uniform, 0.4}, -0.54, 0, 0, 0, 1),
               fit({PartitionRule::Kind::uniform, 0.9}, 0.5251, 0, 0, 0, 1)};
  scanned.scan = scan;
  EXPECT_NE(short_table(scanned).find("B(p) at 2 shares: -0.540 at p = 0.4 to 0.525 at p = 0.9\n"
                                      "p*: B has no zero at any share looked at\n"),
            std::string::npos)
      << short_table(scanned);
}

TEST(ShortTable, CountsTheTablesOfEachMixture)
{
  auto of_two = report();
  of_two.mixtures = {{"Phi_L = 0.30", {0.7, 0.3}, {0, 2}}, {"Phi_L = 0.60", {0.4, 0.6}, {1}}};
  of_two.shares = {{0.25, 0.75}, {0.5, 0.5}};
  const auto text = short_table(of_two);
  EXPECT_NE(text.find("\nPhi_L = 0.30: 2 tables, 25 % of the weight"), std::string::npos) << text;
  EXPECT_NE(text.find("\nPhi_L = 0.60: 1 table, 75 % of the weight"), std::string::npos) << text;
}

}  // namespace
}  // namespace grseg
