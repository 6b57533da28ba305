// SPDX-License-Identifier: GPL-3.0-or-later
// Recognition of tables of one run by their headers, and the order of their windows.
#include "analysis/frames/runs_of_tables.hpp"

#include "formats/cli/provenance.hpp"
#include "formats/core/errors.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace grseg {
namespace {

const std::string sim = "grseg-sim chute.ini -o run.h5";
const std::string longer = "grseg-sim --restart run.chk --duration 3 -o more.h5 (from t = 2 s)";
const std::string twin = "grseg-sim --restart run.chk --perturb 1e-6 -o twin.h5 (from t = 2 s)";
const std::string bed = "grains 213, sizes 206, crc32 0a1b2c3d";

/// A table of one run with a window for each pair of times; `area` is the area of its grains.
Table table_of(const std::string& name, const Header& source, const std::vector<Span>& windows,
               double area = 1)
{
  Table table;
  table.name = name;
  table.header = source;
  table.columns = {"t0[s]",  "t1[s]",  "y0[m]",       "y1[m]",
                   "frames", "V[m^2]", "area_S[m^2]", "A_SS_yy[N m]"};
  for (const auto& [begin, end] : windows)
    table.rows.push_back({begin, end, 0, 0.02, 5, 2, area += 0.01, 3 + 0.1 * begin});
  return table;
}

/// Header that a tool writes for a run with this history.
Header source_of(const std::string& input, const std::vector<std::string>& history,
                 const std::string& bed_line = "")
{
  Header header;
  for (const auto& line : history) header.emplace_back("history", line);
  header.emplace_back("history", "grseg-stress run.h5");
  header.emplace_back("input", "xxh3 " + input);
  if (!bed_line.empty()) header.emplace_back("bed", bed_line);
  return header;
}

Kinship kin(const Header& a, const Header& b)
{
  return kinship(sources_of(table_of("a", a, {})), sources_of(table_of("b", b, {})));
}

TEST(Kinship, ARunAndWhatContinuesItHaveOneBed)
{
  EXPECT_EQ(kin(source_of("1", {sim}), source_of("2", {sim, longer})), Kinship::one_bed);
  EXPECT_EQ(kin(source_of("2", {sim, longer}), source_of("1", {sim})), Kinship::one_bed);
  EXPECT_EQ(kin(source_of("1", {sim, longer}), source_of("2", {sim, twin})), Kinship::one_bed);
  EXPECT_EQ(kin(source_of("1", {sim}, bed + ", seed 1, flow aa"),
                source_of("2", {sim, longer}, bed + ", seed 1, flow aa")),
            Kinship::same_motion);
}

TEST(Kinship, ATwinHasTheBedButAnotherMotion)
{
  EXPECT_EQ(kin(source_of("1", {sim}, bed + ", seed 1, flow aa"),
                source_of("2", {sim, twin}, bed + ", seed 1, flow bb")),
            Kinship::one_bed);
}

TEST(Kinship, TheSameSeedAndSceneAreTheSameMotionWhateverTheHistory)
{
  EXPECT_EQ(kin(source_of("1", {sim}, bed + ", seed 1, flow aa"),
                source_of("2", {"grseg-sim copy.ini --store float32 -o b.h5"},
                          bed + ", seed 1, flow aa")),
            Kinship::same_motion);
}

// If all grains of a species are equal, another seed has the same radii.
TEST(Kinship, GrainsOfFewSizesProveNothingWithoutASeed)
{
  const std::string alike = "grains 213, sizes 2, crc32 0a1b2c3d";
  EXPECT_EQ(
      kin(source_of("1", {"grseg-import a"}, alike), source_of("2", {"grseg-import b"}, alike)),
      Kinship::untold);
  EXPECT_EQ(kin(source_of("1", {sim}, alike + ", seed 1, flow aa"),
                source_of("2", {sim}, alike + ", seed 2, flow bb")),
            Kinship::none);
  EXPECT_EQ(kin(source_of("1", {"grseg-import a"}, bed), source_of("2", {"grseg-import b"}, bed)),
            Kinship::same_grains);
}

TEST(Kinship, OtherGrainsAreAnotherRunUnlessTheyComeAndGo)
{
  const std::string other = "grains 213, sizes 206, crc32 00000000";
  EXPECT_EQ(kin(source_of("1", {sim}, bed + ", seed 1"), source_of("2", {sim}, other + ", seed 2")),
            Kinship::none);
  EXPECT_EQ(kin(source_of("1", {"grseg-import a"}, bed + ", come and go"),
                source_of("2", {"grseg-import a"}, other + ", come and go")),
            Kinship::untold);
}

// Two runs of one command, in different folders, may have different seeds.
TEST(Kinship, EqualCommandsOfOlderTablesProveNothing)
{
  EXPECT_EQ(kin(source_of("1", {sim}), source_of("2", {sim})), Kinship::untold);
  EXPECT_EQ(kin(source_of("1", {sim}), source_of("1", {sim})), Kinship::same_motion);
  EXPECT_EQ(kin(source_of("1", {sim + " --seed 1"}), source_of("2", {sim + " --seed=2"})),
            Kinship::none);
  EXPECT_EQ(kin({}, {}), Kinship::untold);
}

TEST(Kinship, OfMergedTablesIsTheClosestOfTheirRuns)
{
  auto both = source_of("1", {sim + " --seed 1"});
  for (const auto& line : source_of("2", {sim + " --seed 2"})) both.push_back(line);
  both.emplace_back("history", "grseg-merge a.tsv b.tsv");
  EXPECT_EQ(sources_of(table_of("m", both, {})).size(), 2u);
  EXPECT_EQ(kin(both, source_of("3", {sim + " --seed 2", longer})), Kinship::one_bed);
  EXPECT_EQ(kin(both, source_of("3", {sim + " --seed 3"})), Kinship::none);
}

TEST(RunsOfTables, AreNumberedInTheOrderOfTheirTables)
{
  const std::vector<Table> tables{
      table_of("a", source_of("1", {sim}, bed + ", seed 1"), {{0, 1}}),
      table_of("b", source_of("2", {sim}, "grains 9, sizes 9, crc32 1, seed 2"), {{0, 1}}, 7),
      table_of("c", source_of("3", {sim, longer}, bed + ", seed 1"), {{2, 3}})};
  const auto runs = find_runs(tables);
  EXPECT_EQ(runs.run, (std::vector<std::size_t>{0, 1, 0}));
  EXPECT_EQ(runs.doubt(tables), "");
}

// a and c belong to one run only because of b, which continues a and is continued by c.
TEST(RunsOfTables, AreJoinedByTablesBetweenThem)
{
  const std::vector<Table> tables{table_of("a", source_of("1", {sim}), {{0, 1}}),
                                  table_of("c", source_of("3", {"grseg-sim x.ini"}, bed), {{4, 5}}),
                                  table_of("b", source_of("2", {sim, longer}, bed), {{2, 3}})};
  EXPECT_EQ(find_runs(tables).run, (std::vector<std::size_t>{0, 0, 0}));
}

TEST(RunsOfTables, ADoubtNamesTablesThatNothingTellsApart)
{
  const std::vector<Table> tables{table_of("a.tsv", source_of("1", {sim}), {{0, 1}}),
                                  table_of("b.tsv", source_of("2", {sim}), {{0, 1}}, 5)};
  const auto runs = find_runs(tables);
  EXPECT_EQ(runs.run, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(runs.doubt(tables).find("a.tsv, b.tsv count as tables of different runs"), 0u)
      << runs.doubt(tables);
}

TEST(RunsOfTables, OneTimeOfOneMotionCountsOnce)
{
  const auto a = table_of("a", source_of("1", {sim}, bed + ", seed 1, flow aa"), {{0, 1}, {1, 2}});
  const auto same = table_of("b", source_of("2", {sim}, bed + ", seed 1, flow aa"), {{0, 0.5}}, 7);
  const auto twin_of_it =
      table_of("c", source_of("3", {sim, twin}, bed + ", seed 1, flow bb"), {{1, 2}}, 8);
  try {
    find_runs({a, same});
    ADD_FAILURE() << "taken";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("a and b both contain the time from 0 s of the same run (bed: "),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(find_runs({a, twin_of_it}).run, (std::vector<std::size_t>{0, 0}));
}

// Either two parts of an archive, or two runs that began from one list of radii.
TEST(RunsOfTables, ImportsOfTheSameGrainsAreOneRunUnlessTheyHoldTheSameTime)
{
  const auto at = [](const std::string& input, double begin, double area) {
    return table_of(input, source_of(input, {"grseg-import " + input}, bed), {{begin, begin + 1}},
                    area);
  };
  EXPECT_EQ(find_runs({at("a", 0, 1), at("b", 1, 2)}).run, (std::vector<std::size_t>{0, 0}));
  const auto together = find_runs({at("a", 0, 1), at("b", 0, 2)});
  EXPECT_EQ(together.run, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(together.untold, (std::vector<std::size_t>{0, 1}));
}

TEST(RunsOfTables, TablesWithoutStressMayHaveTheSameNumbers)
{
  auto a = table_of("a", source_of("1", {}), {{0, 1}});
  a.rows[0][7] = 0;
  auto b = a;
  b.header = source_of("2", {});
  EXPECT_NO_THROW(find_runs({a, b}));
}

TEST(WindowLine, HoldsTheWindowsOfSeveralTablesInOrderOfTime)
{
  const auto late = table_of("late", {}, {{2, 3}, {3, 4}}),
             early = table_of("early", {}, {{0, 1}, {1, 2}}, 5);
  const auto line =
      put_in_line({{&late, {2, 3}}, {&late, {3, 4}}, {&early, {0, 1}}, {&early, {1, 2}}});
  EXPECT_EQ(line.number, (std::vector<std::size_t>{2, 3, 0, 1}));
  EXPECT_EQ(line.count, 4u);
}

// The windows of a twin begin at other times; each belongs to the window that began before it.
TEST(WindowLine, WindowsThatOverlapAreOneObservation)
{
  const auto a = table_of("a", {}, {{0, 1}, {1, 2}}),
             b = table_of("b", {}, {{0.5, 1.5}, {2, 3}}, 5);
  const auto line = put_in_line({{&a, {0, 1}}, {&a, {1, 2}}, {&b, {0.5, 1.5}}, {&b, {2, 3}}});
  EXPECT_EQ(line.number, (std::vector<std::size_t>{0, 1, 0, 2}));
  EXPECT_EQ(line.count, 3u);
}

TEST(WindowLine, RoundOffIsNoOverlap)
{
  const auto a = table_of("a", {}, {{0, 0.1 + 0.2}}), b = table_of("b", {}, {{0.3, 0.6}}, 5);
  EXPECT_EQ(put_in_line({{&a, {0, 0.1 + 0.2}}, {&b, {0.3, 0.6}}}).count, 2u);
}

TEST(WindowLine, WindowsBetweenWhichNothingMovesAreOneObservation)
{
  auto table = table_of("still", {}, {{0, 1}, {1, 2}, {2, 3}, {3, 4}});
  for (const std::size_t row : {2, 3}) {  // equal to row 1 up to round-off
    table.rows[row][6] = table.rows[1][6] * (1 + 1e-9);
    table.rows[row][7] = table.rows[1][7] * (1 - 1e-9);
  }
  std::vector<TableWindow> windows;
  for (const auto& row : table.rows) windows.push_back({&table, {row[0], row[1]}});
  const auto line = put_in_line(windows);
  EXPECT_EQ(line.number, (std::vector<std::size_t>{0, 1, 1, 1}));
  EXPECT_EQ(line.count, 2u);
  EXPECT_EQ(line.still, 2u);
}

}  // namespace
}  // namespace grseg
