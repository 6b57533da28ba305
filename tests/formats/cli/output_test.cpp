// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/output.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "tests/folder.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

class TableOutput : public TestInFolder {};

TEST_F(TableOutput, AppearsWholeOrNotAtAll)
{
  write_whole({path("t.tsv")}, "first\n");
  write_whole({path("t.tsv"), true}, "second\n");
  EXPECT_EQ(content("t.tsv"), "second\n");
  EXPECT_EQ(names(), std::set<std::string>{"t.tsv"});
  EXPECT_THROW(write_whole({path("missing/t.tsv")}, "x"), RunError);
  std::filesystem::create_directory(path("taken"));
  EXPECT_THROW(write_whole({path("taken")}, "x"), RunError);
  EXPECT_EQ(names(), (std::set<std::string>{"t.tsv", "taken"}));
}

TEST_F(TableOutput, ReplacesNothingUnlessAsked)
{
  write_whole({path("t.tsv")}, "first\n");
  EXPECT_THROW(write_whole({path("t.tsv")}, "second\n"), RunError);
  EXPECT_EQ(content("t.tsv"), "first\n");
}

TEST_F(TableOutput, IsCheckedAgainstEveryInputBeforeWorkBegins)
{
  const auto a = put("a.tsv", "a"), b = put("b.tsv", "b");
  po::variables_map values;
  values.insert({"input", po::variable_value(std::vector<std::string>{"-", a, b}, false)});
  EXPECT_THROW((OutputOptions{b, true}.check(values)), UsageError);
  EXPECT_NO_THROW((OutputOptions{path("c.tsv")}.check(values)));
  EXPECT_NO_THROW((OutputOptions{"-"}.check(values)));
  EXPECT_NO_THROW((OutputOptions{"/dev/null"}.check(values)));
}

// Containers repeat process ids, so a file of a killed process may have the name of this one's.
TEST_F(TableOutput, InPiecesContinuesNoFileThatAKilledProcessLeft)
{
  put(std::filesystem::path(temporary_path(path("t.tsv"))).filename().string(), "junk\n");
  EXPECT_THROW(GrowingTable({path("t.tsv")}), RunError);
  remove_temporaries(path("t.tsv"));
  Table table;
  table.columns = {"a"};
  table.rows = {{1}, {2}};
  GrowingTable growing({path("t.tsv")});
  growing.add(table);
  table.rows = {{3}};
  growing.finish(table);
  EXPECT_EQ(names(), std::set<std::string>{"t.tsv"});
  const auto whole = Table::read(path("t.tsv"));
  EXPECT_EQ(whole.rows, (std::vector<std::vector<double>>{{1}, {2}, {3}}));
}

}  // namespace
}  // namespace grseg
