// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/layer_key.hpp"

#include "formats/core/errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const LayerKey key{1.25, 2.5, 0.02, 0.04, 25, 0.007};

Table one_row(const LayerKey& of)
{
  Table table;
  table.name = "t.tsv";
  table.columns = with_key_columns(2, {"n_SS"});
  table.rows = {with_key(of, {7})};
  return table;
}

TEST(LayerKey, IsTheSameThroughATableAndBack)
{
  const auto table = Table::parse(one_row(key).to_text(), "t.tsv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"t0[s]", "t1[s]", "y0[m]", "y1[m]", "frames",
                                                     "V[m^2]", "n_SS"}));
  EXPECT_EQ(table.rows[0], (std::vector<double>{1.25, 2.5, 0.02, 0.04, 25, 0.007, 7}));
  const auto back = read_layer_keys(table, "")[0];
  for (const auto& column : key_columns) EXPECT_EQ(back.*column.value, key.*column.value);
}

TEST(LayerKey, OnlyHeightsMayBeNanWhichMeansTheWholeBed)
{
  auto whole_bed = key;
  whole_bed.bottom = whole_bed.top = nan;
  EXPECT_TRUE(std::isnan(read_layer_keys(one_row(whole_bed), "")[0].bottom));
  auto wrong = key;
  wrong.frames = nan;
  EXPECT_THROW(read_layer_keys(one_row(wrong), ""), FormatError);
  auto endless = key;
  endless.top = std::numeric_limits<double>::infinity();
  EXPECT_THROW(read_layer_keys(one_row(endless), ""), FormatError);
}

TEST(LayerKey, AMissingColumnIsNamedWithItsRemedy)
{
  auto table = one_row(key);
  table.columns[4] = "numbers";
  try {
    read_layer_keys(table, "make it anew");
    ADD_FAILURE() << "the table was read";
  } catch (const FormatError& error) {
    EXPECT_STREQ(error.what(), "t.tsv: no column 'frames'; make it anew");
  }
}

TEST(RowRange, WindowsAndLayersLieWhollyInsideUpToRoundOff)
{
  const RowRange range{.begin = 1.25, .end = 2.5, .heights = {0.02, 0.04}};
  const auto holds = [&](const LayerKey& k) {
    return range.holds_window(k) && range.holds_layer(k);
  };
  EXPECT_TRUE(holds(key));
  const auto moved = [&](double LayerKey::*member, double by) {
    auto other = key;
    other.*member += by;
    return holds(other);
  };
  for (const double hair : {1e-12, -1e-12})
    for (const auto member : {&LayerKey::begin, &LayerKey::end, &LayerKey::bottom, &LayerKey::top})
      EXPECT_TRUE(moved(member, hair));
  EXPECT_FALSE(moved(&LayerKey::begin, -1e-3));
  EXPECT_FALSE(moved(&LayerKey::end, 1e-3));
  EXPECT_FALSE(moved(&LayerKey::bottom, -1e-3));
  EXPECT_FALSE(moved(&LayerKey::top, 1e-3));
  EXPECT_TRUE(moved(&LayerKey::bottom, 1e-3));
}

TEST(RowRange, TheWholeBedLiesBetweenAnyHeights)
{
  auto whole_bed = key;
  whole_bed.bottom = whole_bed.top = nan;
  EXPECT_TRUE((RowRange{.heights = {1, 2}}.holds_layer(whole_bed)));
}

}  // namespace
}  // namespace grseg
