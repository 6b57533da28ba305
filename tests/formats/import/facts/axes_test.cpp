// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/axes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

const double sin_30 = 0.5, cos_30 = std::sqrt(3) / 2;

Orientation plane(const std::string& letters, const Vec3& gravity, std::optional<double> slope = {})
{
  return orientation_of(letters, GravityText{std::nullopt, gravity}, slope, 2);
}

/// Velocity of the contact point of a disc on a base below it, in the plane of the flow.
double slip(const Axes& axes, const Vec3& velocity, const Vec3& angular_velocity, double radius)
{
  return axes.components(velocity).x() + axes.spin_in_plane(angular_velocity) * radius;
}

// Without slip v + omega x (r_contact - x) = 0; this product is right-handed in all axes.
TEST(Axes, ARollingDiscRollsInEveryPlane)
{
  const double radius = 0.25;
  for (const auto& [letters, normal] : {std::pair{"xy", Vec3(0, 1, 0)},
                                        {"xz", Vec3(0, 0, 1)},
                                        std::pair{"yz", Vec3(0, 0, 1)},
                                        {"zx", Vec3(1, 0, 0)}}) {
    const Axes axes(letters);
    for (const Vec3& spin : {Vec3(0, 0, 3), Vec3(0, 2, 0), Vec3(-1, 0, 0)}) {
      const Vec3 arm = -radius * normal;
      const Vec3 velocity(-(spin.y() * arm.z() - spin.z() * arm.y()),
                          -(spin.z() * arm.x() - spin.x() * arm.z()),
                          -(spin.x() * arm.y() - spin.y() * arm.x()));
      EXPECT_DOUBLE_EQ(slip(axes, velocity, spin, radius), 0) << letters;
    }
  }
  EXPECT_EQ(Axes("xz").spin_in_plane({0, 2, 0}), -2);
  EXPECT_EQ(Axes("xy").spin_in_plane({0, 0, 2}), 2);
}

TEST(Axes, GravityAloneTurnsNothing)
{
  const auto p = plane("xz", {5, 0, -8});
  EXPECT_EQ(p.gravity, Vec3(5, -8, 0));
  EXPECT_EQ(p.axes.components({1, 2, 3}).head<2>(), Vec2(1, 3));
  EXPECT_EQ(p.axes.axis_of(0), 0);
}

TEST(Axes, FlowToTheLeftIsLookedAtFromBehind)
{
  const auto p = plane("xy", {-5, -8, 0});
  EXPECT_EQ(p.gravity, Vec3(5, -8, 0));
  EXPECT_EQ(p.axes.components({1, 2, 0}).head<2>(), Vec2(-1, 2));
  EXPECT_EQ(p.axes.spin_in_plane({0, 0, 3}), -3);
  EXPECT_FALSE(p.axes.is_forward(0));
}

TEST(Axes, VerticalGravityIsTurnedToTheSlopeOfTheBase)
{
  const auto p = plane("xy", {0, -10, 0}, 30);
  EXPECT_TRUE(p.gravity.isApprox(Vec3(10 * sin_30, -10 * cos_30, 0)));
  // The flow is down the slope of a base that falls to the right.
  EXPECT_TRUE(p.axes.components({cos_30, -sin_30, 0}).head<2>().isApprox(Vec2(1, 0)));
  EXPECT_TRUE(p.axes.components({sin_30, cos_30, 0}).head<2>().isApprox(Vec2(0, 1)));
  EXPECT_NEAR(p.axes.spin_in_plane({0, 0, 3}), 3, 1e-15);
  EXPECT_FALSE(p.axes.axis_of(0));
}

TEST(Axes, AVectorOfFewDigitsThatHasTheSlopeTurnsNothing)
{
  const auto p = plane("xy", {3.83, -9.02, 0}, 23);
  EXPECT_EQ(p.axes.axis_of(0), 0);
  EXPECT_EQ(p.gravity, Vec3(3.83, -9.02, 0));
}

TEST(Axes, AMagnitudeNeedsASlope)
{
  const auto p = orientation_of("xy", parse_gravity("10"), 30, 2);
  EXPECT_TRUE(p.gravity.isApprox(Vec3(5, -10 * cos_30, 0)));
  EXPECT_THROW(orientation_of("xy", parse_gravity("10"), std::nullopt, 2), UsageError);
}

TEST(Axes, SignsOfZerosSurvive)
{
  EXPECT_TRUE(std::signbit(Axes("xy").components({-0.0, 1, 2}).x()));
}

TEST(Axes, AWrongPlaneOrGravityIsRefused)
{
  for (const char* letters : {"", "x", "xx", "xw", "xyz"})
    EXPECT_THROW(Axes{letters}, UsageError) << letters;
  EXPECT_THROW(plane("xy", {0, 0, -10}), UsageError);
  for (const char* text : {"", "down", "1,2", "1,2,3,4", "1,,2", "-9.8", "nan", "1,2,x"})
    EXPECT_THROW(parse_gravity(text), UsageError) << text;
  EXPECT_EQ(*parse_gravity("1,-2,0.5").vector, Vec3(1, -2, 0.5));
}

TEST(Axes, AcrossIsWhatMakesThemRightHanded)
{
  EXPECT_EQ(Axes("xy").components({1, 2, 3}), Vec3(1, 2, 3));
  EXPECT_EQ(Axes("xz").components({1, 2, 3}), Vec3(1, 3, -2));
  EXPECT_EQ(Axes("yz").components({1, 2, 3}), Vec3(2, 3, 1));
  EXPECT_EQ(Axes("xz").components({1, 2, 3}), Vec3(1, 3, -2));
  EXPECT_EQ(Axes("xz").axis_of(2), 1);
  EXPECT_FALSE(Axes("xz").is_forward(2));
}

TEST(Axes, FromBehindAcrossIsTheOtherWayToo)
{
  const auto p = orientation_of("xz", parse_gravity("-5,1,-8"), {}, 3);
  EXPECT_EQ(p.gravity, Vec3(5, -8, 1));
  EXPECT_EQ(p.axes.components({1, 2, 3}), Vec3(-1, 3, 2));
  EXPECT_EQ(p.axes.components({1, 2, 3}), Vec3(-1, 3, 2));
  EXPECT_TRUE(p.axes.is_forward(2));
}

TEST(Axes, GravityInSpaceKeepsItsComponentAcross)
{
  const auto p = orientation_of("xy", parse_gravity("0,-10,2"), 30, 3);
  EXPECT_TRUE(p.gravity.isApprox(Vec3(10 * sin_30, -10 * cos_30, 2)));
  EXPECT_EQ(p.axes.axis_of(2), 2);
  EXPECT_THROW(orientation_of("xy", parse_gravity("0,-10,2"), 30, 2), UsageError);
}

TEST(Axes, GravityAcrossTheNormalMeansOtherAxes)
{
  const auto complain = [](const std::string& letters, const Vec3& gravity) {
    const auto orientation = orientation_of(letters, {std::nullopt, gravity}, std::nullopt, 3);
    require_towards_the_base(gravity, orientation, letters);
  };
  EXPECT_THROW(complain("xy", {4.3, 0, -8.8}), UsageError);
  EXPECT_NO_THROW(complain("xz", {4.3, 0, -8.8}));
  EXPECT_NO_THROW(complain("xy", {0, 0, 0})) << "there is none";
}

}  // namespace
}  // namespace grseg
