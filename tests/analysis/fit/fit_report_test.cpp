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

FitReport report_of_rules()
{
  const auto data = neutral_data(0.1);
  FitReport report;
  report.header = {{"program", "grseg-fit"}};
  report.inputs = {"run.h5 0123456789abcdef"};
  report.history = {"grseg-sim chute.ini", "grseg-stress run.h5"};
  for (const char* rule : {"size", "drop", "uniform:0.8"})
    report.rules.push_back(synthetic::fit(data, rule));
  for (auto& fit : report.rules) add_doubt(fit, "windows are few");
  report.scan = scan_partition(data, parse_scan("0.5:0.8:0.1"), {});
  return report;
}

/// Rows of a quantity under a rule, in order.
std::vector<NumberRow> rows_of(const FitReport& report, const std::string& rule,
                               const std::string& quantity)
{
  auto rows = number_rows(report);
  std::erase_if(rows,
                [&](const NumberRow& row) { return row.rule != rule || row.quantity != quantity; });
  return rows;
}

TEST(FitReport, EveryNumberHasARowWithItsIntervalAndWhatThatIsOver)
{
  const auto report = report_of_rules();
  const auto b = rows_of(report, "size", "B");
  ASSERT_EQ(b.size(), 1u);  // one run: only an interval over its windows
  EXPECT_EQ(b[0].over, "windows");
  EXPECT_EQ(b[0].number.value, report.rules[0].value.B);
  EXPECT_EQ(b[0].number.low, report.rules[0].low.B);
  EXPECT_EQ(b[0].degrees, report.rules[0].degrees);
  EXPECT_EQ(rows_of(report, "uniform:0.8", "B_minus_size")[0].number.high,
            report.rules[2].minus_size.estimate().high);
  EXPECT_EQ(rows_of(report, "-", "p_zero")[0].number.value, report.rules[0].line.p_zero.value);
  EXPECT_EQ(rows_of(report, "-", "dB_dp")[0].number.low, report.rules[0].line.dB_dp.estimate().low);
  EXPECT_EQ(rows_of(report, "-", "points")[0].number.value, 210);
  EXPECT_EQ(rows_of(report, "-", "points")[0].over, "-");
}

TEST(FitReport, ARuleWhosePartsDoNotAddUpHasNoB)
{
  auto report = report_of_rules();
  EXPECT_TRUE(rows_of(report, "drop", "B").empty());
  EXPECT_TRUE(rows_of(report, "drop", "paper_k").empty());  // this number was not asked for
  report.with_paper = true;
  EXPECT_EQ(rows_of(report, "drop", "paper_k")[0].number.value, report.rules[1].value.paper_k);
  EXPECT_TRUE(rows_of(report, "drop", "paper_B").empty());
}

TEST(FitReport, JsonHoldsTheRowsOfTheTable)
{
  const auto report = report_of_rules();
  const auto json = nlohmann::json::parse(to_json(report));
  const auto rows = number_rows(report);
  ASSERT_EQ(json["numbers"].size(), rows.size());
  EXPECT_EQ(json["numbers"][0]["rule"], "size");
  EXPECT_EQ(json["numbers"][0]["quantity"], "B");
  EXPECT_EQ(json["numbers"][0]["value"], rows[0].number.value);
  EXPECT_EQ(json["numbers"][1]["quantity"], "share");
  EXPECT_TRUE(json["numbers"][1]["low"].is_null());
  EXPECT_EQ(json["scan"].size(), 4u);
  EXPECT_EQ(json["scan"][1][0], 0.6);
  EXPECT_EQ(json["scan"][1][1], report.scan->fits[1].value.B);
  EXPECT_EQ(json["doubts"].size(), 1u);  // one doubt for all rules
  EXPECT_EQ(json["inputs"][0], "run.h5 0123456789abcdef");
  EXPECT_EQ(json["history"].size(), 2u);
}

// Two slopes are two flows, which a column with the slope distinguishes.
TEST(FitReport, WhatFlowsDifferInHasAColumnWithItsUnit)
{
  auto report = report_of_rules();
  report.scan.reset();
  report.flows = {{"slope = 21 degrees", {0.7, 0.3}, {0}, {{"slope[degree]", "21"}}},
                  {"slope = 26 degrees", {0.7, 0.3}, {1}, {{"slope[degree]", "26"}}}};
  report.shares = {0.25, 0.75};
  report.rules.resize(1);
  report.rules.push_back(report.rules[0]);
  report.rules[0].flow = 1;
  const auto text = to_tsv(report);
  EXPECT_TRUE(holds(text,
                    "\nrule\tflow\tpair\tcomponent\tquantity\tover\tvalue\tlow\thigh\t"
                    "degrees_of_freedom\tslope[degree]\n"));
  EXPECT_TRUE(holds(text, "\nsize\tslope = 26 degrees\t"));
  EXPECT_TRUE(holds(text, "\t26\n"));
  EXPECT_TRUE(holds(text, "\nsize\tall\t"));
}

TEST(FitReport, TheTablesOfAFlowAreAListInJsonAndALineInTheTable)
{
  auto report = report_of_rules();
  report.table_names = {"a.tsv", "b c.tsv", "d\n.tsv"};
  report.flows = {{"Phi_L = 0.30", {0.7, 0.3}, {0, 2}}, {"Phi_L = 0.60", {0.4, 0.6}, {1}}};
  report.shares = {0.25, 0.75};
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["flows"][0]["tables"], nlohmann::json({"a.tsv", "d\\x0a.tsv"}));
  EXPECT_EQ(json["flows"][1]["tables"], nlohmann::json({"b c.tsv"}));
  EXPECT_TRUE(
      holds(to_tsv(report), "# flow: Phi_L = 0.60, 1 table, 75 % of the weight: b c.tsv\n"));
}

TEST(FitReport, WhatLimitsTheIntervalsIsAmongTheLinesOfTheTableAndInJson)
{
  auto report = report_of_rules();
  report.rules[0].doubt = "too few";
  EXPECT_TRUE(holds(to_tsv(report), "# doubt: size: too few\n"));
  EXPECT_EQ(nlohmann::json::parse(to_json(report))["doubts"][0], "size: too few");
}

TEST(FitReport, AScanIsATableOfBOverTheShareWithTheLineInItsHeader)
{
  const auto report = report_of_rules();
  const auto scan = Table::parse(to_tsv(report), "scan");
  ASSERT_EQ(scan.rows.size(), 4u);
  EXPECT_EQ(scan.rows[3][scan.column("B")], report.scan->fits[3].value.B);
  EXPECT_EQ(scan.header_number("p_zero"), report.scan->line.p_zero.value);
  EXPECT_EQ(scan.header_number("dB_dp_high"), report.scan->line.dB_dp.estimate().high);
  EXPECT_TRUE(
      holds(to_tsv(report), "# history: grseg-sim chute.ini\n# history: grseg-stress run.h5\n"));
}

}  // namespace
}  // namespace grseg
