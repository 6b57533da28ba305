// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/pair_search.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

/// Positions of `count` bodies on a lattice of spacing 1, ten bodies high.
std::vector<Vec2> lattice(int count)
{
  std::vector<Vec2> position;
  for (int k = 0; k < count; ++k) position.push_back({k / 10 + 0.5, k % 10});
  return position;
}

TEST(CellGrid, TheNumberOfStripsIsEvenIfXIsPeriodic)
{
  for (const bool periodic : {true, false}) {
    CellGrid<2> grid({5300, 10, periodic}, 1.2, 1);
    grid.sort(lattice(53000));
    EXPECT_EQ(grid.strips(), periodic ? 14u : 15u);
  }
}

TEST(CellGrid, ASmallSceneIsOneStrip)
{
  CellGrid<2> grid({900, 10, true}, 1.2, 1);
  grid.sort(lattice(9000));
  EXPECT_EQ(grid.strips(), 1u);
}

TEST(CellGrid, NoStripIsNarrowerThanFourColumns)
{
  CellGrid<2> grid({10, 5000, true}, 1.2, 1);  // eight columns
  auto tall = lattice(80000);
  for (auto& x : tall) std::swap(x.x(), x.y());
  grid.sort(tall);
  EXPECT_EQ(grid.strips(), 2u);
  for (std::size_t s = 0; s < grid.strips(); ++s)
    EXPECT_GE(grid.first_column(s + 1) - grid.first_column(s), 4);
}

TEST(CellGrid, ABodyThatHasFlownFarAwayAddsFewCells)
{
  for (const Vec2& far : {Vec2(1e9, 0), Vec2(0, 1e9), Vec2(-1e9, 1e9)}) {
    CellGrid<2> grid({100, 10, false}, 1.2, 1);
    auto position = lattice(1000);
    position[500] = far;
    grid.sort(position);
    EXPECT_LT(static_cast<double>(grid.columns()) * grid.bands(), 10000);
  }
}

TEST(CellGrid, SortsEveryBodyIntoItsCellStripByStrip)
{
  const auto position = lattice(50000);
  CellGrid<2> grid({5000, 10, true}, 1.2, 2);
  grid.sort(position);
  const auto& order = grid.order();
  std::vector<int> seen(position.size());
  std::uint32_t end = 0;
  for (std::size_t s = 0; s < grid.strips(); ++s) {
    EXPECT_EQ(grid.bodies_of_strip(s).begin, end);
    for (std::int32_t band = 0; band < grid.bands(); ++band) {
      for (auto c = grid.first_column(s); c < grid.first_column(s + 1); ++c) {
        const auto bodies = grid.bodies(c, c, band, 0);
        EXPECT_EQ(bodies.begin, end);
        end = bodies.end;
        for (auto b = bodies.begin; b < bodies.end; ++b) {
          ++seen[order[b]];
          const auto& x = position[order[b]];
          EXPECT_GE(x.x(), c * grid.column_width() - 1e-9);
          EXPECT_LE(x.x(), (c + 1) * grid.column_width() + 1e-9);
          EXPECT_GE(x.y(), band * 1.2 - 1e-9);
        }
      }
    }
    EXPECT_EQ(grid.bodies_of_strip(s).end, end);
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 50000);
}

}  // namespace
}  // namespace grseg
