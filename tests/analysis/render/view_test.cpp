// SPDX-License-Identifier: GPL-3.0-or-later
// Part of a cell that a picture shows, and positions on the page.
#include "analysis/render/view.hpp"

#include "analysis/render/painter.hpp"
#include "formats/core/errors.hpp"
#include "tests/folder.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <vector>

namespace grseg {
namespace {

constexpr LengthUnits units{0.005, 0.01};

Box box_2d()
{
  return {.length_x = 10, .length_y = 5, .periodic_x = true};
}

Box box_3d()
{
  return {.length_x = 10,
          .length_y = 5,
          .periodic_x = true,
          .dimension = 3,
          .length_z = 4,
          .periodic_z = true};
}

View view_2d()
{
  View view(Plane::xy, box_2d());
  view.region = {{0, 0}, {10, 5}};
  return view;
}

std::vector<double> images_along_x(const View& view, const Vec2& centre, double radius)
{
  const Vec2 reach = Vec2::Constant(radius);
  std::vector<double> shifts;
  view.for_images(centre - reach, centre + reach,
                  [&](const Vec2& shift) { shifts.push_back(shift.x()); });
  return shifts;
}

using Numbers = std::vector<double>;

TEST(View, AGrainInsideIsSeenOnce)
{
  EXPECT_EQ(images_along_x(view_2d(), {5, 1}, 1), Numbers{0});
}

TEST(View, AGrainThatCrossesAPeriodIsSeenOnBothSides)
{
  EXPECT_EQ(images_along_x(view_2d(), {0.5, 1}, 1), (Numbers{0, 10}));
  EXPECT_EQ(images_along_x(view_2d(), {9.5, 1}, 1), (Numbers{-10, 0}));
}

TEST(View, ARegionBeyondThePeriodRepeatsTheCell)
{
  auto view = view_2d();
  view.region = {{-10, 0}, {20, 5}};
  EXPECT_EQ(images_along_x(view, {5, 1}, 1), (Numbers{-10, 0, 10}));
}

TEST(View, WhatLiesAboveOrBesideIsNotSeen)
{
  auto view = view_2d();
  EXPECT_EQ(images_along_x(view, {5, 7}, 1), Numbers{});
  view.region = {{2, 0}, {3, 5}};
  EXPECT_EQ(images_along_x(view, {5, 1}, 1), Numbers{});
}

TEST(View, PlanesAreRightHandedTowardsWhoLooks)
{
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  struct Case {
    Plane plane;
    Vec3 right, up;
  };
  for (const auto& [plane, right, up] :
       {Case{Plane::xy, x, y}, Case{Plane::zy, z, y}, Case{Plane::zx, z, x}}) {
    const View view(plane, box_3d());
    EXPECT_EQ(view.flat<3>(right), Vec2(1, 0));
    EXPECT_EQ(view.flat<3>(up), Vec2(0, 1));
    const Vec3 towards = right.cross(up);
    EXPECT_EQ(*view.nearness<3>(towards) - *view.nearness<3>(Vec3(-towards)), 2);
  }
}

TEST(View, ASlabHoldsCentresAndGoesAcrossThePeriod)
{
  View view(Plane::xy, box_3d());
  view.slab = Range{3.5, 4.5};
  EXPECT_FALSE(view.nearness<3>({0, 0, 3.4}));
  EXPECT_EQ(*view.nearness<3>({0, 0, 3.75}), 3.75);
  EXPECT_EQ(*view.nearness<3>({0, 0, 0.25}), 4.25);  // nearer: it enters from behind z = 4
  EXPECT_FALSE(view.nearness<3>({0, 0, 0.6}));
}

TEST(View, ARegionIsTypedInLengthsAndMayLeaveOutEnds)
{
  const Region whole{{0, 0}, {10, 5}};
  const auto region = parse_region("-2dS:40mm,:1m", view_2d(), whole, units);
  EXPECT_EQ(region.low, Vec2(-0.01, 0));
  EXPECT_EQ(region.high, Vec2(0.04, 1));
}

TEST(View, RegionsThatCannotBeAreRefused)
{
  const auto refused = [](const std::string& text) {
    return complaint_of<UsageError>([&] {
      parse_region(text, view_2d(), {{0, 0}, {10, 5}}, units);
    });
  };
  EXPECT_EQ(refused("0:1"),
            "--region '0:1': give both axes of the picture, as in 0:40dS,0:20dS or :,0:20dS");
  EXPECT_EQ(
      refused("1m:1m,:"),
      "--region '1m:1m': it begins at 1 m and ends at 1 m; the first must be the smaller one");
  EXPECT_EQ(refused("0:201m,:"), "--region '0:201m,:': it spans more than 20 periods of 10 m");
  EXPECT_EQ(refused("0,1"), "--region '0': write its begin and end, as in 0:20dS");
  EXPECT_EQ(refused("0:4dX,:"),
            "--region '4dX' is not a length: give a number with a unit, as in 0.02m, 20mm, "
            "4dS, 2dL");
}

TEST(Projection, TheMiddleOfTheRegionLiesInTheMiddleOfThePanelAndYPointsUp)
{
  const Projection to_page({{0, 0}, {10, 4}}, {500, 300}, 100, 0);
  EXPECT_EQ(to_page({5, 2}), Vec2(500, 300));
  EXPECT_EQ(to_page({0, 4}), Vec2(0, 100));
  EXPECT_EQ(to_page({10, 0}), Vec2(1000, 500));
}

// A slope of 30 degrees: gravity is (1/2, -sqrt(3)/2); turned by -30 degrees it points down.
TEST(Projection, ATurnedPictureHasGravityDownThePage)
{
  const double angle = -std::numbers::pi / 6;
  const Projection to_page({{0, 0}, {10, 4}}, {500, 300}, 1, angle);
  const Vec2 down = to_page.direction({0.5, -std::sqrt(3) / 2});
  EXPECT_NEAR(down.x(), 0, 1e-15);
  EXPECT_NEAR(down.y(), 1, 1e-15);
  const Vec2 along = to_page.direction({1, 0});  // down the slope: to the right and downwards
  EXPECT_NEAR(along.x(), std::sqrt(3) / 2, 1e-15);
  EXPECT_NEAR(along.y(), 0.5, 1e-15);
}

TEST(Projection, ATurnedRegionNeedsTheRoomOfItsCorners)
{
  const Region region{{0, 0}, {10, 4}};
  EXPECT_EQ(turned_size(region, 0), Vec2(10, 4));
  const Vec2 quarter = turned_size(region, std::numbers::pi / 2);
  EXPECT_NEAR(quarter.x(), 4, 1e-12);
  EXPECT_NEAR(quarter.y(), 10, 1e-12);
  const Vec2 eighth = turned_size(region, -std::numbers::pi / 4);
  EXPECT_NEAR(eighth.x(), 14 / std::sqrt(2), 1e-12);
}

}  // namespace
}  // namespace grseg
