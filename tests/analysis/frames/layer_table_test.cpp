// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/layer_key.hpp"
#include "formats/core/errors.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Table table_of(const std::vector<LayerKey>& keys)
{
  Table table;
  table.name = "t.tsv";
  table.columns = with_key_columns(2, {"n_SS"});
  for (const auto& key : keys) table.rows.push_back(with_key(key, {7}));
  return table;
}

std::string refusal(const Table& table)
{
  try {
    read_layer_keys(table, "make it anew");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "";
}

std::string refusal(const std::vector<LayerKey>& keys)
{
  return refusal(table_of(keys));
}

LayerKey key(double begin, double end, double bottom, double top)
{
  return {begin, end, bottom, top, 25, 0.007};
}

TEST(LayerTable, HoldsEachLayerOfAWindowOnce)
{
  EXPECT_EQ(refusal({key(0, 1, 0, 0.02), key(0, 1, 0.02, 0.04), key(1, 2, 0, 0.02)}), "");
  EXPECT_EQ(refusal({key(0, 1, 0, 0.02), key(1, 2, 0, 0.02), key(0, 1, 0, 0.02)}),
            "t.tsv: row 3 repeats the window and layer of row 1");
  EXPECT_EQ(refusal({key(0, 1, nan, nan), key(0, 1, 0, 0.02), key(1, 2, nan, nan)}), "");
  EXPECT_EQ(refusal({key(0, 1, nan, nan), key(0, 1, 0, 0.02), key(0, 1, nan, nan)}),
            "t.tsv: row 3 repeats the window and layer of row 1");
}

TEST(LayerTable, HasNoVolumeForABedBelowTheBase)
{
  auto bed = key(0, 1, nan, nan), layer = key(0, 1, 0, 0.02);
  bed.volume = layer.volume = nan;
  EXPECT_EQ(refusal({bed, key(0, 1, 0, 0.02)}), "");
  EXPECT_NE(refusal({layer}), "");
}

TEST(LayerTable, HoldsNoWindowsAndLayersThatOverlapBeyondRoundOff)
{
  EXPECT_EQ(refusal({key(1, 2, 0, 0.02), key(0, 1.5, 0, 0.02)}),
            "t.tsv: the windows of rows 1 and 2 overlap");
  EXPECT_EQ(refusal({key(0, 1, 0, 0.02), key(0, 1, 0.01, 0.03)}),
            "t.tsv: the layers of rows 1 and 2 overlap");
  EXPECT_EQ(refusal({key(0, 0.3, 0, 0.02), key(0.1 + 0.2 - 1e-15, 0.6, 0, 0.02)}), "");
  EXPECT_EQ(refusal({key(0, 1, 0, 0.02), key(0, 1, 0.02 - 1e-15, 0.04)}), "");
}

TEST(LayerTable, UnitsAreThoseOfGrseg)
{
  auto table = table_of({key(0, 1, 0, 0.02)});
  table.columns[5] = "V[mm^2]";
  EXPECT_EQ(refusal(table), "t.tsv: column 'V[mm^2]' should be 'V[m^2]'; units are not converted");
  table.columns[5] = "V";
  EXPECT_EQ(refusal(table), "");  // a table made by hand is accepted
  table.header = {{"program", "grseg-stress 0.1.0"}};
  EXPECT_EQ(refusal(table), "t.tsv: column 'V' should be 'V[m^2]'; units are not converted");
}

TEST(LayerTable, LengthsAndTimesInTheHeaderArePositive)
{
  for (const char* name : {"small_diameter", "large_diameter", "step", "layer", "window"}) {
    auto table = table_of({key(0, 1, 0, 0.02)});
    table.header = {{name, "0.01"}};
    EXPECT_EQ(refusal(table), "");
    table.header = {{name, "0"}};
    EXPECT_EQ(refusal(table), "t.tsv: '# " + std::string(name) + ": 0' should be positive");
  }
}

}  // namespace
}  // namespace grseg
