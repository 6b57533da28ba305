// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_report.hpp"

#include "tests/analysis/synthetic_fits.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace grseg {
namespace {

using synthetic::holds;
using synthetic::neutral_data;

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
  for (const char* key :
       {"rule", "component", "quantity", "slope", "slope_interval", "exponent", "B_half", "B_mean",
        "B_direct", "B_interval", "points", "estimators", "used_by", "share"})
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
  EXPECT_EQ(json["p_zero_interval"][0], report.scan->p_zero_interval.low);
  EXPECT_EQ(json["dB_dp"], report.scan->dB_dp);
  EXPECT_EQ(json["dB_dp_interval"][1], report.scan->dB_dp_interval.high);
  EXPECT_EQ(json["rules"][2]["used_by"], "-");
  EXPECT_EQ(json["doubts"].size(), 1u);  // too few windows, of all rules
  EXPECT_EQ(json["inputs"][0], "run.h5 0123456789abcdef");
  EXPECT_EQ(json["history"].size(), 2u);
}

TEST(FitReport, TheTablesOfAMixtureAreAListInJsonAndALineInTheTable)
{
  auto report = report_with_seed(1);
  report.table_names = {"a.tsv", "b c.tsv", "d\n.tsv"};
  report.mixtures = {{"Phi_L = 0.30", {0.7, 0.3}, {0, 2}}, {"Phi_L = 0.60", {0.4, 0.6}, {1}}};
  report.shares = {{0.25, 0.75}, {0.5, 0.5}};
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["mixtures"][0]["tables"], nlohmann::json({"a.tsv", "d\\x0a.tsv"}));
  EXPECT_EQ(json["mixtures"][1]["tables"], nlohmann::json({"b c.tsv"}));
  EXPECT_TRUE(
      holds(to_tsv(report),
            "# mixture: Phi_L = 0.60, 1 table, 75 % of the weight of B_half, 50 % of that of "
            "B_sums: b c.tsv\n"));
}

// p* of the sums is that of the data, whatever the rules beside the scan.
TEST(FitReport, AScanHasTheZeroOfTheSumsAlsoWhereTheLastRuleDoesNotAddUp)
{
  auto report = report_with_seed(1);
  const double zero = report.rules[0].p_zero_sums.value;
  ASSERT_TRUE(std::isfinite(zero));
  report.rules = {report.rules[1]};  // drop
  EXPECT_EQ(Table::parse(to_tsv(report), "scan").header_number("p_zero_sums"), zero);
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["p_zero_sums"]["value"], zero);
  EXPECT_LT(json["p_zero_sums"]["interval"][0], zero);
}

TEST(FitReport, WhatLimitsTheIntervalsIsAmongTheLinesOfTheTableAndInJson)
{
  auto report = report_with_seed(1);
  report.rules[0].doubt = "too few";
  EXPECT_TRUE(holds(to_tsv(report), "# doubt: size: too few\n"));
  EXPECT_EQ(nlohmann::json::parse(to_json(report))["doubts"][0], "size: too few");
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
