// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/sums_table.hpp"
#include "tests/analysis/micro/sums_rows.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

TEST(Pooling, WindowsArePooledAsMeansWeightedByTheirFrames)
{
  auto later = layer(0.5);
  later.begin = 1;
  later.end = 2;
  later.frames = 30;
  later.sums = layer(0.5).sums * 3;
  const auto rows = pooled<2>({layer(0.5), later, bed_of_height(20, 0)}, Pool::windows);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].frames, 40);
  EXPECT_EQ(rows[0].begin, 0);
  EXPECT_EQ(rows[0].end, 2);
  EXPECT_EQ(rows[0].bottom, 4);
  EXPECT_EQ(rows[0].volume, 125);
  EXPECT_NEAR(rows[0].sums.of(Species::small).ends, 2.5 * layer(0.5).sums.of(Species::small).ends,
              1e-11);
  EXPECT_NEAR(rows[0].sums.coordination(Species::small), 4, 1e-13);
  EXPECT_TRUE(rows[1].is_bed());
}

// Bounds of the third layer, computed with 7 mm and with 1.4 times 5 mm.
TEST(Pooling, LayersThatDifferByRoundOffAreOne)
{
  auto one = layer(0.5), other = layer(0.5);
  one.bottom = 2 * 0.007;
  one.top = 3 * 0.007;
  other.bottom = 2 * (1.4 * 0.005);
  other.top = 3 * (1.4 * 0.005);
  ASSERT_NE(one.bottom, other.bottom);
  other.begin = 1;
  other.end = 2;
  const auto rows = pooled<2>({one, other}, Pool::windows);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].bottom, one.bottom);
  EXPECT_EQ(rows[0].top, one.top);
}

TEST(Pooling, LayersOfLikeCompositionArePooledAndTheBedLeftOut)
{
  auto empty = layer(0.5);
  empty.sums = {};
  const auto rows = pooled<2>(
      {layer(0.51), layer(0.35), layer(0.59), layer(1), layer(0.95), empty, bed_of_height(20, 0)},
      Pool::composition);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_NEAR(rows[0].sums.phi_large(), 0.35, 1e-14);
  EXPECT_NEAR(rows[1].sums.phi_large(), 0.55, 1e-14);
  EXPECT_NEAR(rows[2].sums.phi_large(), 0.975, 1e-14);
}

TEST(Pooling, RowsAreChosenByWindowAndHeightButTheBedByWindowAlone)
{
  auto later = layer(0.5);
  later.begin = 1;
  later.end = 2;
  auto higher = layer(0.5);
  higher.bottom = 6;
  higher.top = 8;
  const std::vector<SumsRow<2>> rows{layer(0.5), later, higher, bed_of_height(20, 0)};
  EXPECT_EQ(filtered(rows, {.end = 1}, {1, 2}).size(), 3u);
  EXPECT_EQ(filtered(rows, {.heights = "4dS:6dS"}, {1, 2}).size(), 3u);
  EXPECT_EQ(filtered(rows, {.begin = 1, .heights = ":6dS"}, {1, 2}).size(), 1u);
}

// A bed of twelve layers loses its upper half; 4 d_S are two layers.
TEST(Pooling, InsideIsOfTheTimesThatArePooled)
{
  std::vector<SumsRow<2>> rows;
  for (int window = 0; window < 2; ++window)
    for (int k = 0; k < (window == 0 ? 12 : 6); ++k) {
      auto& row = rows.emplace_back(layer(0.5));
      row.begin = window;
      row.end = window + 1;
      row.bottom = 2 * k;
      row.top = 2 * (k + 1);
    }
  const auto late = filtered(rows, {.begin = 1, .heights = "inside"}, {1, 2});
  ASSERT_EQ(late.size(), 2u);
  EXPECT_EQ(late[0].bottom, 4);
}

}  // namespace
}  // namespace grseg
