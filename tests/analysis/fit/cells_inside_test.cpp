// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/cells_inside.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace grseg {
namespace {

constexpr double side = 0.5;

/// A map of 12 by 10 full cells, in two windows.
std::vector<LayerSolid> full_map()
{
  std::vector<LayerSolid> rows;
  for (int window = 0; window < 2; ++window)
    for (int j = 0; j < 10; ++j)
      for (int i = 0; i < 12; ++i)
        rows.push_back({{.begin = double(window),
                         .end = window + 1.0,
                         .bottom = j * side,
                         .top = (j + 1) * side,
                         .frames = 5,
                         .volume = 1,
                         .left = i * side - 1,
                         .right = (i + 1) * side - 1},
                        0.8});
  return rows;
}

long inside(const std::vector<LayerSolid>& rows, const OpenEnds& ends, double margin)
{
  const auto all = cells_inside(rows, ends, margin);
  return std::count(all.begin(), all.end(), true) / 2;
}

TEST(CellsInside, CellsKeepTheirDistanceFromTheEndsOfAMap)
{
  const auto rows = full_map();
  EXPECT_EQ(inside(rows, {}, 1.0), 8 * 6);
  EXPECT_EQ(inside(rows, {}, 1.1), 6 * 4);
  EXPECT_EQ(inside(rows, {}, 0), 12 * 10);
  EXPECT_EQ(inside(rows, {{true, false}}, 1.0), 12 * 6);
  EXPECT_EQ(inside(rows, {{false, true}}, 1.0), 8 * 10);
  EXPECT_EQ(inside(rows, {{false, true}, true}, 1.0), 10 * 10);
}

TEST(CellsInside, CellsKeepTheirDistanceFromCellsThatAreLessThanHalfFull)
{
  auto rows = full_map();
  const auto fill = [&](double window, double solid) {
    for (auto& row : rows)
      if (row.key.begin == window && row.key.left == 1.5 && row.key.bottom == 2) row.solid = solid;
  };
  fill(0, 0);  // the mean over windows is half
  EXPECT_EQ(inside(rows, {{true, true}}, 1.0), 12 * 10);
  fill(1, 0.7);
  EXPECT_EQ(inside(rows, {{true, true}}, 1.0), 12 * 10 - 5 * 5);
  EXPECT_EQ(inside(rows, {{true, true}}, 0), 12 * 10 - 1);
}

// A drum of radius 9.5, less than half full: no grains at the axis, a few in the next annulus, so
// that the surface is at 2. Half of the outermost annulus lies outside its wall.
TEST(AnnuliInside, ReachFromAMarginUnderTheSurfaceToAMarginWithinTheWall)
{
  std::vector<LayerSolid> annuli;
  for (int window = 0; window < 2; ++window)
    for (int k = 0; k < 11; ++k) {
      const double solid = k == 0 || k == 10 ? 0 : k == 1 ? 0.1 : k == 9 ? 0.2 : 0.4;
      annuli.push_back({{.bottom = double(k), .top = k + 1.0, .frames = 5}, solid});
    }
  const auto range = annuli_inside(annuli, 2);
  EXPECT_DOUBLE_EQ(range.lowest, 2 + 2);
  EXPECT_DOUBLE_EQ(range.highest, 9.5 - 2);
  annuli[0].solid = annuli[11].solid = 0.4;
  EXPECT_DOUBLE_EQ(annuli_inside(annuli, 2).lowest, 0);  // the bed goes on at the axis
  EXPECT_FALSE(annuli_inside({}, 2).holds(0, 1));
}

}  // namespace
}  // namespace grseg
