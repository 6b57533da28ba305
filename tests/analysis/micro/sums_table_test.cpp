// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/sums_table.hpp"

#include "formats/core/errors.hpp"
#include "tests/analysis/micro/sums_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Table table_of(const std::vector<SumsRow<2>>& rows)
{
  Table table;
  table.name = "micro.tsv";
  table.columns = {"t0[s]", "t1[s]", "y0[m]", "y1[m]", "frames", "V[m^2]"};
  for (const auto& cell : StructureSums<2>{}.cells()) table.columns.push_back(cell.column);
  for (const char* name : {"yL[m]", "yS[m]", "height[m]"}) table.columns.emplace_back(name);
  for (const auto& row : rows) {
    std::vector<double> values{row.begin, row.end, row.bottom, row.top, row.frames, row.volume};
    for (const auto& cell : row.sums.cells()) values.push_back(cell.value);
    for (const double h : {row.heights.large, row.heights.small, row.heights.bed})
      values.push_back(h);
    table.rows.push_back(values);
  }
  return table;
}

TEST(SumsTable, LayersFindTheHeightOfTheBedInTheirOwnWindow)
{
  auto later = layer(0.5);
  later.begin = 1;
  later.end = 2;
  const auto rows =
      read_sums_rows<2>(table_of({layer(0.5), bed_of_height(20, 0), later, bed_of_height(22, 1)}));
  EXPECT_EQ(rows[0].bed_height, 20);
  EXPECT_EQ(rows[2].bed_height, 22);
  EXPECT_EQ(values_of(rows[2].sums.cells()), values_of(later.sums.cells()));
  EXPECT_TRUE(rows[3].is_bed());
  EXPECT_FALSE(rows[2].is_bed());
}

TEST(SumsTable, AMissingColumnIsNamed)
{
  auto table = table_of({layer(0.5)});
  table.columns[table.column("c2_LS")] = "c3_LS";
  try {
    read_sums_rows<2>(table);
    FAIL();
  } catch (const FormatError& error) {
    EXPECT_STREQ(error.what(),
                 "micro.tsv: no column 'c2_LS'; grseg-derive needs a table of grseg-micro");
  }
}

TEST(SumsTable, NaNIsRefusedExceptForSlidingContactsOfUnknownFriction)
{
  auto table = table_of({layer(0.5)});
  table.rows[0][table.column("n_slide_SS")] = nan;
  EXPECT_EQ(read_sums_rows<2>(table).size(), 1u);
  table.rows[0][table.column("ends_L")] = nan;
  try {
    read_sums_rows<2>(table);
    FAIL();
  } catch (const FormatError& error) {
    EXPECT_NE(std::string(error.what()).find("ends_L"), std::string::npos) << error.what();
  }
}

TEST(SumsTable, AreasAndNumbersAreNotNegative)
{
  for (const char* name : {"area_L", "grains_S", "ends_L", "n_LS"}) {
    auto table = table_of({layer(0.5)});
    table.rows[0][table.column(name)] = -1;
    EXPECT_THROW(read_sums_rows<2>(table), FormatError) << name;
  }
}

TEST(SumsTable, WhatWasNotKeptHasNoValue)
{
  auto table = table_of({layer(0.5)});
  table.header = {{"not kept", "n_strong_SS c2_LS"}};
  const auto at = static_cast<std::ptrdiff_t>(table.column("c2_LS"));
  table.columns.erase(table.columns.begin() + at);
  table.rows[0].erase(table.rows[0].begin() + at);
  const auto sums = read_sums_rows<2>(table)[0].sums;
  EXPECT_TRUE(std::isnan(sums.of(PairType::LS).fabric.normal.x()));
  EXPECT_EQ(sums.of(PairType::LS).fabric.normal.y(),
            layer(0.5).sums.of(PairType::LS).fabric.normal.y());
}

}  // namespace
}  // namespace grseg
