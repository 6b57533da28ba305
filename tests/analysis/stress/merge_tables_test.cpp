// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/merge_tables.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/version.hpp"
#include "tests/analysis/synthetic_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace grseg {
namespace {

using synthetic::TableRow;

ContactSums<2> sums(double large)
{
  auto some = synthetic::neutral_sums(0.5, 2);
  some.of(OwnSum::inside, 1) = large * synthetic::any_tensor();
  return some;
}

/// Row of window `window` (0.1 s) and layer `layer` (0.02 m).
TableRow row(int window, int layer, double frames, double large)
{
  return {0.1 * window, 0.1 * window + 0.1, frames, sums(large), 0.02 * layer, 0.02 * layer + 0.02};
}

Table table(const std::string& input, const std::vector<TableRow>& rows)
{
  auto made = synthetic::stress_table(rows);
  made.name = input + ".tsv";
  made.header = {{"program", "grseg-stress 0.1.0"},
                 {"history", "grseg-sim of " + input},
                 {"input", "xxh3 " + input},
                 {"step", "0.001"},
                 {"layer", "0.02"},
                 {"window", "0.1"},
                 {"assign", "contact-point"},
                 {"small_diameter", "0.005"},
                 {"large_diameter", "0.01"}};
  return made;
}

Table merged(const std::vector<Table>& tables, bool all_windows = false)
{
  constexpr ToolInfo info{"grseg-stress", "", "", ""};
  return merge_tables(tables, all_windows, info, "grseg-merge");
}

double cell(const Table& table, std::size_t row, const std::string& column)
{
  return table.rows.at(row).at(table.column(column));
}

/// Message of the Error thrown while merging; "" if there is none.
template <class Error>
std::string sentence(const std::vector<Table>& tables)
{
  try {
    merged(tables);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool holds(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST(MergeTables, OneWindowOfTwoRunsIsTheirMeanWeightedByFrames)
{
  const auto t = merged({table("a", {row(0, 0, 10, 1)}), table("b", {row(0, 0, 30, 5)})});
  ASSERT_EQ(t.rows.size(), 1u);
  EXPECT_EQ(cell(t, 0, "frames"), 40);
  EXPECT_DOUBLE_EQ(cell(t, 0, "A_LL_yy"), 4 * 1.1);
  EXPECT_DOUBLE_EQ(cell(t, 0, "A_LL_xy"), 4 * -0.41);
  EXPECT_DOUBLE_EQ(cell(t, 0, "area_L"), 0.8);
  EXPECT_EQ(cell(t, 0, "V"), 2);
  EXPECT_EQ(cell(t, 0, "t1"), 0.1);
  EXPECT_EQ(cell(t, 0, "y1"), 0.02);
}

// Frames in which the layer was empty count, as they do within a run.
TEST(MergeTables, ALayerThatOneRunDoesNotReachIsEmptyThere)
{
  const auto t =
      merged({table("a", {row(0, 0, 10, 1)}), table("b", {row(0, 0, 30, 1), row(0, 1, 30, 4)})});
  ASSERT_EQ(t.rows.size(), 2u);
  EXPECT_EQ(cell(t, 1, "frames"), 40);
  EXPECT_DOUBLE_EQ(cell(t, 1, "A_LL_yy"), 3 * 1.1);
  EXPECT_DOUBLE_EQ(cell(t, 1, "area_S"), 0.75 * 0.8);
}

// The runs differ in composition, or in a key of their scenes such as the start of the bed.
TEST(MergeTables, TablesOfDifferentFlowsAreRefused)
{
  const auto with_scene = [](const std::string& input, const std::string& scene) {
    auto made = table(input, {row(0, 0, 10, input == "a" ? 1 : 2)});
    made.header.insert(made.header.begin() + 3, {"scene", scene});
    return made;
  };
  const auto mixed = with_scene("a", "initial = mixed; seed = 1; slope-rate = 2");
  EXPECT_EQ(
      merged({mixed, with_scene("b", "initial = mixed; seed = 2; slope-rate = 2")}).rows.size(),
      1u);
  EXPECT_EQ(
      sentence<UsageError>({mixed, with_scene("b", "initial = large-above; seed = 2")}),
      "a.tsv and b.tsv are of different flows (initial = mixed and large-above), and a mean over "
      "both is of neither; give tables of one flow, which differ in their seed alone");
  EXPECT_TRUE(
      holds(sentence<UsageError>({mixed, with_scene("b", "initial = mixed; slope-rate = 4")}),
            "(slope-rate = 2 and 4)"));
  auto rich = row(0, 0, 10, 1);
  rich.sums.content = {0.6, 1.0};
  EXPECT_TRUE(holds(sentence<UsageError>({table("a", {row(0, 0, 10, 2)}), table("b", {rich})}),
                    "(Phi_L = 0.50 and Phi_L = 0.62)"));
}

TEST(MergeTables, WindowsStayApartUnlessAllAreAsked)
{
  const std::vector<Table> tables{table("a", {row(2, 0, 10, 1), row(3, 0, 10, 2)}),
                                  table("b", {row(3, 0, 10, 6)})};
  const auto apart = merged(tables), together = merged(tables, true);
  ASSERT_EQ(apart.rows.size(), 2u);
  EXPECT_EQ(apart.rows[0], tables[0].rows[0]);  // a window of one run is not changed in any bit
  EXPECT_DOUBLE_EQ(cell(apart, 1, "A_LL_yy"), 4 * 1.1);
  ASSERT_EQ(together.rows.size(), 1u);
  EXPECT_EQ(cell(together, 0, "frames"), 30);
  EXPECT_DOUBLE_EQ(cell(together, 0, "A_LL_yy"), 3 * 1.1);
  EXPECT_EQ(cell(together, 0, "t0"), 0.2);
  EXPECT_EQ(cell(together, 0, "t1"), 0.1 * 3 + 0.1);
  EXPECT_DOUBLE_EQ(together.header_number("window"), 0.2);
}

TEST(MergeTables, TimesThatDifferByRoundingAreTheSameWindow)
{
  auto b = table("b", {row(3, 0, 10, 3)});
  b.rows[0][0] = 0.3 - 1e-15;  // table a has 0.1 * 3 here
  const auto a = table("a", {row(3, 0, 10, 1)});
  ASSERT_NE(a.rows[0][0], b.rows[0][0]);
  EXPECT_EQ(merged({a, b}).rows.size(), 1u);
}

// As for a run and its continuation from t = 2 s on: 2.2 - 2 is 0.20000000000000018.
TEST(MergeTables, AWindowThatWasWrittenAsADifferenceOfTimesIsThatOfTheOthers)
{
  auto a = table("a", {row(0, 0, 10, 1)}), b = table("b", {row(3, 0, 10, 3)});
  b.header[5].second = format_number((2 + 0.1) - 2);
  ASSERT_NE(b.header[5], a.header[5]);
  EXPECT_EQ(merged({a, b}).rows.size(), 2u);
  b.header[5].second = "0.101";
  EXPECT_TRUE(holds(sentence<FormatError>({a, b}), "'# window: 0.1' and '# window: 0.101'"));
  b.header[5].second = "0.1";
  b.header[4].second = "0.019999999999999997";  // 4 times 0.005, computed differently
  EXPECT_EQ(merged({a, b}).rows.size(), 2u);
}

TEST(MergeTables, AllWindowsTogetherMayHaveHadAnyLength)
{
  auto b = table("b", {{0.1, 0.4, 30, sums(2), 0, 0.02}});
  b.header[5].second = "0.3";
  const auto t = merged({table("a", {row(0, 0, 10, 1)}), b}, true);
  EXPECT_EQ(t.header_number("window"), 0.4);
  EXPECT_EQ(cell(t, 0, "frames"), 40);
}

// The tables do not show whether a and b are different runs; c has another seed than d.
TEST(MergeTables, SayWhereTablesMayBeOfOneRun)
{
  const auto doubt = merged({table("a", {row(0, 0, 10, 1)}), table("b", {row(0, 0, 30, 5)})});
  EXPECT_TRUE(holds(doubt.header_text("doubt"), "a.tsv, b.tsv count as tables of different runs"));
  auto c = table("c", {row(0, 0, 10, 1)}), d = table("d", {row(0, 0, 30, 5)});
  for (auto* one : {&c, &d})
    one->header.insert(one->header.begin() + 1, {"history", "grseg-sim x.ini --seed " + one->name});
  EXPECT_FALSE(merged({c, d}).has_header("doubt"));
}

TEST(MergeTables, TheOrderOfTablesChangesNoByte)
{
  std::vector<Table> tables{table("b", {row(0, 0, 7, 0.1), row(0, 1, 7, 1e-9)}),
                            table("c", {row(0, 0, 11, 0.3), row(1, 0, 11, 3)}),
                            table("a", {row(0, 0, 13, 1e3), row(1, 1, 13, 0.7)})};
  const auto text = merged(tables).to_text();
  const auto by_name = [](const Table& a, const Table& b) { return a.name < b.name; };
  std::sort(tables.begin(), tables.end(), by_name);
  do EXPECT_EQ(merged(tables).to_text(), text);
  while (std::next_permutation(tables.begin(), tables.end(), by_name));
}

TEST(MergeTables, MergingStepByStepIsMergingAtOnce)
{
  const auto a = table("a", {row(0, 0, 7, 0.1)}), b = table("b", {row(0, 0, 5, 0.7)}),
             c = table("c", {row(0, 0, 3, 0.3), row(0, 1, 3, 2)});
  const auto at_once = merged({a, b, c}), in_steps = merged({merged({a, b}), c});
  ASSERT_EQ(in_steps.rows.size(), at_once.rows.size());
  for (std::size_t k = 0; k < at_once.rows.size(); ++k)
    for (std::size_t column = 0; column < at_once.columns.size(); ++column)
      EXPECT_NEAR(in_steps.rows[k][column], at_once.rows[k][column], 1e-14);
}

TEST(MergeTables, HistoriesAndDigestsOfAllTablesAreKept)
{
  const auto t = merged({table("b", {row(0, 0, 1, 2)}), table("a", {row(0, 0, 1, 1)})});
  const std::vector<std::pair<std::string, std::string>> header{
      {"program", std::string("grseg-stress ") + version()},
      {"history", "grseg-sim of a"},
      {"input", "xxh3 a"},
      {"history", "grseg-sim of b"},
      {"input", "xxh3 b"},
      {"history", "grseg-merge"},
      {"doubt", t.header_text("doubt")},
      {"step", "0.001"},
      {"layer", "0.02"},
      {"window", "0.1"},
      {"assign", "contact-point"},
      {"small_diameter", "0.005"},
      {"large_diameter", "0.01"}};
  EXPECT_EQ(t.header, header);
}

TEST(MergeTables, TablesMadeDifferentlyAreRefusedWithBothNames)
{
  const auto a = table("a", {row(0, 0, 1, 1)});
  auto b = table("b", {row(0, 0, 1, 1)});
  b.header[4].second = "0.01";
  EXPECT_EQ(sentence<FormatError>({a, b}),
            "a.tsv and b.tsv were made differently: '# layer: 0.02' and '# layer: 0.01'; only "
            "tables with the same layers, windows and rules can be merged");
  b = table("b", {row(0, 0, 1, 1)});
  b.header.emplace_back("width", "0.005");
  EXPECT_TRUE(holds(sentence<FormatError>({a, b}), "nothing and '# width: 0.005'"));
  EXPECT_TRUE(holds(sentence<FormatError>({b, a}), "'# width: 0.005' and nothing"));
  b = table("b", {row(0, 0, 1, 1)});
  b.columns.back() = "another";
  EXPECT_EQ(sentence<FormatError>({a, b}), "a.tsv and b.tsv have different columns");
}

TEST(MergeTables, TheSameTimeOfOneRunDoesNotCountTwice)
{
  const auto a = table("a", {row(0, 0, 1, 1), row(1, 0, 1, 1)});
  EXPECT_TRUE(
      holds(sentence<UsageError>({a, a}), "a.tsv and a.tsv both contain the time from 0 s"));
  const auto rest = table("a", {row(2, 0, 1, 1)}), part = table("a", {row(1, 0, 1, 1)});
  EXPECT_EQ(merged({a, rest}).rows.size(), 3u);
  EXPECT_TRUE(holds(sentence<UsageError>({a, rest, part}), "the time from 0.1 s"));
  const auto shifted = table("a", {{0.25, 0.35, 1, sums(1)}});  // half in the last one of `rest`
  EXPECT_TRUE(holds(sentence<UsageError>({rest, shifted}), "both contain the time from 0.2"));
  const auto with_b = merged({a, table("b", {row(0, 0, 1, 2)})});
  EXPECT_TRUE(holds(sentence<UsageError>({with_b, part}), "of the same run (xxh3 a)"));
}

TEST(MergeTables, TheSameNumbersUnderAnotherDigestDoNotCountTwice)
{
  EXPECT_EQ(sentence<UsageError>({table("a", {row(0, 0, 1, 1)}), table("b", {row(0, 0, 1, 1)})}),
            "a.tsv and b.tsv both contain the time from 0 s of the same run (all numbers are the "
            "same); give only one of them, because counting it twice makes intervals too narrow");
}

TEST(MergeTables, WindowsThatOverlapInPartAreMergedOnlyWithAllOthers)
{
  const std::vector<Table> tables{table("a", {row(2, 0, 1, 1)}),
                                  table("b", {{0.25, 0.35, 1, sums(2), 0, 0.02}})};
  EXPECT_TRUE(
      holds(sentence<UsageError>(tables), "a.tsv and b.tsv have windows that partly overlap"));
  EXPECT_EQ(merged(tables, true).rows.size(), 1u);
}

TEST(MergeTables, DamagedTablesAreNamedWithTheRow)
{
  const auto a = table("a", {row(0, 0, 1, 1)});
  EXPECT_TRUE(holds(sentence<FormatError>({a, table("b", {row(0, 0, 1, 1), row(0, 1, 2, 1)})}),
                    "b.tsv: row 2: 2 frames, but other rows of its window have 1"));
  EXPECT_TRUE(holds(sentence<FormatError>({a, table("b", {row(0, 0, 0, 1)})}), "b.tsv: row 1"));
  EXPECT_TRUE(holds(sentence<FormatError>({a, table("b", {row(0, 0, 1, 1), row(0, 0, 1, 1)})}),
                    "b.tsv: row 2 repeats the window and layer of row 1"));
  auto b = table("b", {row(0, 0, 1, 1)});
  b.rows[0][12] = std::nan("");
  EXPECT_TRUE(holds(sentence<FormatError>({a, b}), "b.tsv: row 1, column"));
  b = table("b", {row(0, 0, 1, 1)});
  std::swap(b.columns[4], b.columns[5]);
  EXPECT_TRUE(holds(sentence<FormatError>({b}), "column 5 is 'V[m^2]', but"));
  EXPECT_TRUE(holds(sentence<UsageError>({}), "no tables given"));
  b = table("b", {row(0, 0, 1, 1)});
  b.header[3].second = "1e-300";
  EXPECT_TRUE(holds(sentence<FormatError>({b}), "b.tsv: row 1: does not fit the step"));
  b.header[3].second = "0";
  EXPECT_TRUE(holds(sentence<FormatError>({b}), "b.tsv: '# step: 0' should be positive"));
}

}  // namespace
}  // namespace grseg
