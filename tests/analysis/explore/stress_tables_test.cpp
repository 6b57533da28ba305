// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/stress_tables.hpp"

#include "tests/folder.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

Table table_of(const std::string& name, const std::string& program,
               const std::vector<std::string>& inputs)
{
  Table table;
  table.name = name;
  table.header = {{"program", program}};
  for (const auto& input : inputs) table.header.emplace_back("input", input);
  return table;
}

const std::vector<RunIdentity> runs{{"xxh3 00000000000000aa", "grains 3, seed 1, flow 12ab34cd"},
                                    {"xxh3 00000000000000bb", "grains 4"}};
const std::vector<std::string> digests{runs[0].digest, runs[1].digest};

TEST(TablesOfRuns, ATableBelongsToTheRunWithItsDigest)
{
  const std::vector<Table> tables{table_of("b.tsv", "grseg-stress 0.2.0", {digests[1]})};
  const auto found = tables_of_runs(tables, runs);
  EXPECT_EQ(found[0], nullptr);
  EXPECT_EQ(found[1], &tables[0]);
}

// Another file of the same flow contains, for example, some of its frames for a film. A bed without a
// flow is a bed of an import, which several runs may have.
TEST(TablesOfRuns, ATableBelongsToAnotherFileOfItsFlow)
{
  auto table = table_of("a.tsv", "grseg-stress 0.2.0", {"xxh3 00000000000000cc"});
  table.header.emplace_back("bed", runs[0].bed);
  EXPECT_NE(tables_of_runs({table}, runs)[0], nullptr);
  table.header.back().second = runs[1].bed;
  EXPECT_THROW(tables_of_runs({table}, runs), FormatError);
}

TEST(TablesOfRuns, TablesOfOtherRunsAndOfSeveralRunsAreRefused)
{
  const auto refused = [](const Table& table) {
    return complaint_of<FormatError>([&] { tables_of_runs({table}, runs); });
  };
  EXPECT_EQ(
      refused(table_of("c.tsv", "grseg-stress 0.2.0", {"xxh3 00000000000000cc"})),
      "c.tsv: is of the run with the digest xxh3 00000000000000cc, and no run given has this digest "
      "or the same bed; add that run, make the table again, or leave the table out: its sums are "
      "then made from the run");
  EXPECT_EQ(refused(table_of("m.tsv", "grseg-stress 0.2.0", digests)),
            "m.tsv: is made of 2 runs; give tables of one run each");
}

TEST(TablesOfRuns, TwoTablesOfOneRunAreRefused)
{
  const auto table = table_of("a.tsv", "grseg-stress 0.2.0", {digests[0]});
  EXPECT_EQ(complaint_of<UsageError>([&] {
              tables_of_runs({table, table}, runs);
            }),
            "a.tsv and a.tsv are of the same run; give one of them");
}

TEST(SpeciesOfATable, OtherSpeciesThanTheRunsAreRefused)
{
  auto table = table_of("a.tsv", "grseg-stress 0.2.0", {digests[0]});
  const auto two = two_sizes(0.005, 0.01);
  const SpeciesList three{{"c1", 0.004}, {"c2", 0.005}, {"c3", 0.01}};
  require_same_species(table, two);
  EXPECT_EQ(
      complaint_of<UsageError>([&] { require_same_species(table, three); }),
      "a.tsv: has the species small, large, but its run has c1 0.004, c2 0.005, c3 0.01; give both "
      "the same --group, --classes or --edges, or leave the table out");
  table.header.emplace_back("species", species_text(three));
  require_same_species(table, three);
  EXPECT_NE(complaint_of<UsageError>([&] { require_same_species(table, two); }), "");
}

}  // namespace
}  // namespace grseg
