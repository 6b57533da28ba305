// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/table.hpp"

#include "formats/core/errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace grseg {
namespace {

Table sample()
{
  Table table;
  table.header = {{"program", "grseg-stress 0.1.0"}, {"layer", "0.02"}, {"history", "a: b"}};
  table.columns = {"t0[s]", "A_SS_xx[N m]", "n_SS"};
  table.rows = {{0, 1.0 / 3, 7}, {1.25, -1e-300, std::nan("")}};
  return table;
}

std::string complaint(const std::string& text)
{
  try {
    Table::parse(text, "t.tsv");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(Table, AsJsonSeparatesSettingsInputsAndHistory)
{
  auto table = sample();
  table.header.insert(table.header.begin(), {{"input", "xxh3 1"}, {"history", "first \"word\""}});
  EXPECT_EQ(table.to_json(),
            "{\"columns\":[\"t0[s]\",\"A_SS_xx[N m]\",\"n_SS\"],"
            "\"rows\":[[0.0,0.3333333333333333,7.0],[1.25,-1e-300,null]],"
            "\"settings\":{\"program\":\"grseg-stress 0.1.0\",\"layer\":\"0.02\"},"
            "\"inputs\":[\"xxh3 1\"],\"history\":[\"first \\\"word\\\"\",\"a: b\"]}\n");
}

TEST(Table, ReadsBackEveryBitOfWhatItPrints)
{
  const auto read = Table::parse(sample().to_text(), "t.tsv");
  EXPECT_EQ(read.header, sample().header);
  EXPECT_EQ(read.columns, sample().columns);
  EXPECT_EQ(read.rows[0], sample().rows[0]);
  EXPECT_EQ(read.rows[1][1], -1e-300);
  EXPECT_TRUE(std::isnan(read.rows[1][2]));
  EXPECT_EQ(read.to_text(), sample().to_text());
}

TEST(Table, FindsColumnsByNameWithoutUnit)
{
  EXPECT_EQ(sample().column("A_SS_xx"), 1u);
  EXPECT_FALSE(sample().has_column("A_SS"));
  EXPECT_THROW(sample().column("A_SS"), FormatError);
}

TEST(Table, HeaderNumbersAreNumbers)
{
  EXPECT_EQ(sample().header_number("layer"), 0.02);
  EXPECT_THROW(sample().header_number("program"), FormatError);
  EXPECT_THROW(sample().header_text("slope"), FormatError);
}

TEST(Table, ThatIsTruncatedIsRefusedWithItsLine)
{
  const auto text = sample().to_text();
  EXPECT_EQ(complaint(text.substr(0, text.size() - 1)),
            "t.tsv: the last line is incomplete; the table is truncated");
  EXPECT_EQ(complaint("a\tb\n1\t2\n3\n"),
            "t.tsv: line 3: 1 columns, but the header names 2; is the table truncated?");
  EXPECT_EQ(complaint("a\tb\n1\tx2\n"), "t.tsv: line 2: 'x2' is not a number");
  EXPECT_EQ(complaint(""), "t.tsv: is empty, not a table");
  EXPECT_EQ(
      complaint("\x89HDF\r\n\x1a\n"),
      "t.tsv: is an HDF5 file, not a table; if it is a run, make its table with grseg-stress");
  EXPECT_EQ(complaint("# only: comments\n"),
            "t.tsv: has no line of column names, so it is not a table");
}

}  // namespace
}  // namespace grseg
