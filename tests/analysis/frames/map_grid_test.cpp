// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/map_grid.hpp"

#include "formats/core/errors.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

const Box closed{10, 8, false}, periodic{10, 8, true};

MapGrid grid_of(const Packing& packing, const Box& box, double side)
{
  GrainExtent<2> extent(std::nullopt);
  extent.add(packing.grains, packing.frame);
  return map_grid<2>(MapPlane::xy, side, box, extent, std::nullopt);
}

/// Two spheres of radius 1 in a cell of 12 by 20.
struct TwoSpheres {
  Grains grains;
  Frame<3> frame;
  Box box{12, 8, false, 3, 20, true};

  TwoSpheres(const Vec3& a, const Vec3& b)
  {
    for (const auto& place : {a, b}) {
      grains.id.push_back(static_cast<std::int32_t>(grains.size()));
      grains.species.push_back(Species::small);
      grains.radius.push_back(1);
      grains.mass.push_back(1);
      grains.fixed.push_back(0);
      frame.position.push_back(place);
    }
  }
  MapGrid grid(MapPlane plane, double side, std::optional<Vec2> axis = std::nullopt) const
  {
    GrainExtent<3> extent(axis);
    extent.add(grains, frame);
    return map_grid<3>(plane, side, box, extent, axis);
  }
};

TEST(MapGrid, AlongAPeriodCellsAreAWholeNumberAndNoLongerThanAsked)
{
  const auto axis = periodic_axis('x', 3, 10);
  EXPECT_EQ(axis.cells, 4u);
  EXPECT_EQ(axis.side, 2.5);
  EXPECT_EQ(periodic_axis('x', 0.1, 0.3).cells, 3u);  // in doubles 0.3/0.1 < 3
  EXPECT_EQ(periodic_axis('x', 20, 10).cells, 1u);
}

TEST(MapGrid, WhatLeavesThroughThePeriodComesInAtTheOtherEnd)
{
  const auto axis = periodic_axis('x', 2.5, 10);
  EXPECT_EQ(axis.at(0), 0u);
  EXPECT_EQ(axis.at(9.9), 3u);
  EXPECT_EQ(axis.at(10.1), 0u);
  EXPECT_EQ(axis.at(-0.1), 3u);
}

TEST(MapGrid, ACellHoldsItsLowerEdgeAndNotItsUpper)
{
  EXPECT_EQ(open_axis('x', 0.1, 0, 1).cells, 10u);
  for (const double side : {0.1, 0.07, 0.3, 0.005, 0.013, 0.0007, 0.0049}) {
    const MapAxis axis{'x', side, 0, 5000, false};
    for (std::size_t n = 0; n < axis.cells; ++n) {
      ASSERT_EQ(axis.at(axis.edge(n)), n) << side;
      ASSERT_EQ(axis.at(std::nextafter(axis.edge(n + 1), 0)), n) << side;
    }
  }
}

TEST(MapGrid, GrainsBelowZeroHaveCellsAndEdgesAreMultiplesOfTheSide)
{
  Packing packing;
  packing.grain(Species::small, 0.5, {-2.25, -0.75});
  packing.grain(Species::large, 1, {3, 2});
  const auto grid = grid_of(packing, closed, 1);
  const auto& [x, y] = grid.axes;
  EXPECT_EQ(x.edge(0), -3);
  EXPECT_EQ(x.edge(x.cells), 4);
  EXPECT_EQ(y.edge(0), -2);
  EXPECT_EQ(y.edge(y.cells), 3);  // the large grain ends at this edge; no empty row follows
  EXPECT_EQ(grid.at<2>({-2.25, -0.75}), 1 * x.cells + 0);
  EXPECT_EQ(grid.at<2>({3, 2}), 4 * x.cells + 6);
  EXPECT_EQ(grid.volume(0), 1);
}

TEST(MapGrid, WhatLiesBeyondTheGrainsCountsToTheOutermostCell)
{
  const auto axis = open_axis('y', 1, -2, 3);
  EXPECT_EQ(axis.at(-7), 0u);
  EXPECT_EQ(axis.at(7), 4u);
}

TEST(MapGrid, ThePeriodIsMappedWhereverGrainsAre)
{
  Packing packing;
  packing.grain(Species::small, 0.5, {9.75, 2});
  const auto x = grid_of(packing, periodic, 2).axes[0];
  EXPECT_EQ(x.edge(0), 0);
  EXPECT_EQ(x.edge(x.cells), 10);
}

TEST(MapGrid, InThreeDimensionsVolumesAreThoseOfWhatIsSummedOver)
{
  const TwoSpheres two({2, 1, 3}, {9, 5, 18});
  const auto xy = two.grid(MapPlane::xy, 2), xz = two.grid(MapPlane::xz, 3);
  EXPECT_EQ(xy.axes[0].cells, 5u);  // 0 to 10
  EXPECT_EQ(xy.volume(0), 2 * 2 * 20);
  EXPECT_EQ(xz.depth, 2 * (1 + 5) / 2.0);  // the bed is twice as high as its centre of mass
  EXPECT_EQ(xz.axes[1].cells, 7u);
  EXPECT_NEAR(xz.volume(0), 3 * 20 / 7.0 * 6, 1e-12);
  EXPECT_EQ(xz.at<3>({4, 100, 6}), 2 * xz.axes[0].cells + 1);
}

TEST(MapGrid, CellsOfRzAreRings)
{
  const TwoSpheres two({5, 8, 3}, {5, 1, 18});
  const auto rz = two.grid(MapPlane::rz, 2, Vec2{5, 4});
  const auto& r = rz.axes[0];
  EXPECT_EQ(r.edge(0), 0);
  EXPECT_EQ(r.cells, 3u);  // the surface of the farther sphere is 5 from the axis
  for (std::size_t n = 0; n < 3; ++n)
    EXPECT_NEAR(rz.volume(n),
                std::numbers::pi * (r.edge(n + 1) * r.edge(n + 1) - r.edge(n) * r.edge(n)) * 2,
                1e-12);
  EXPECT_EQ(rz.at<3>({5 + 3 * 0.6, 4 + 3 * 0.8, 4.5}), 2 * r.cells + 1);
}

TEST(MapGrid, ALostGrainOrABedBelowZeroIsNamed)
{
  Packing packing;
  packing.grain(Species::small, 0.5, {1, 2});
  packing.grain(Species::small, 0.5, {1, 1e9});
  EXPECT_THROW(grid_of(packing, periodic, 1), RunError);
  EXPECT_THROW(grid_of(Packing{}, periodic, 1), RunError);
  EXPECT_THROW(TwoSpheres({2, -3, 3}, {9, -5, 18}).grid(MapPlane::xz, 3), RunError);
}

}  // namespace
}  // namespace grseg
