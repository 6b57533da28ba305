// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/layers.hpp"

#include "formats/core/errors.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace grseg {
namespace {

using std::numbers::pi;

TEST(Layers, HalfADiscLiesBelowItsCentre)
{
  EXPECT_DOUBLE_EQ(disc_area_below(2, 0), 2 * pi);
  EXPECT_DOUBLE_EQ(disc_area_below(2, 2), 4 * pi);
  EXPECT_DOUBLE_EQ(disc_area_below(2, 7), 4 * pi);
  EXPECT_NEAR(disc_area_below(2, -2), 0, 1e-15);
  EXPECT_NEAR(disc_area_below(2, -7), 0, 1e-15);
}

// A chord at half the radius spans 120 degrees: the cap is the sector pi/3 minus the triangle sqrt(3)/4.
TEST(Layers, TheCapBeyondHalfARadiusIsSectorLessTriangle)
{
  EXPECT_NEAR(disc_area_below(1, -0.5), pi / 3 - std::sqrt(3) / 4, 1e-15);
  EXPECT_NEAR(disc_area_below(1, 0.5), pi - (pi / 3 - std::sqrt(3) / 4), 1e-15);
}

TEST(Layers, AHeightOnAnEdgeBelongsToTheLayerAbove)
{
  const Layers layers(0.02, 0.35);
  for (std::size_t n = 0; n < 2000; ++n) {
    EXPECT_EQ(layers.at(layers.bottom(n)), n);
    if (n > 0) {
      EXPECT_EQ(layers.at(std::nextafter(layers.bottom(n), 0.0)), n - 1);
    }
  }
}

TEST(Layers, TheFirstLayerTakesAllBelowTheBase)
{
  EXPECT_EQ(Layers(0.02, 0.35).at(-3), 0u);
}

TEST(Layers, TheVolumeOfALayerIsItsThicknessTimesTheCell)
{
  EXPECT_DOUBLE_EQ(Layers(0.02, 0.35).volume(0), 0.007);
}

TEST(Layers, TheLastLayerIsReachedByTheTopOfTheHighestMobileGrain)
{
  const Layers layers(1, 10);
  Packing packing;
  packing.grain(Species::boundary, 1, {0, 7});
  EXPECT_EQ(layers.count(packing.grains, packing.frame), 1u);
  packing.grain(Species::small, 0.5, {0, 1.25});
  EXPECT_EQ(layers.count(packing.grains, packing.frame), 2u);
  packing.frame.position[1].y() = 1.5;  // just touches the edge at 2
  EXPECT_EQ(layers.count(packing.grains, packing.frame), 2u);
  packing.frame.position[1].y() = 1.75;
  EXPECT_EQ(layers.count(packing.grains, packing.frame), 3u);
}

TEST(Layers, ALostGrainIsReportedAndNotCounted)
{
  Packing packing;
  packing.grain(Species::small, 0.5, {0, 1e9});
  EXPECT_THROW(Layers(1, 10).count(packing.grains, packing.frame), RunError);
}

TEST(Layers, ADiscKeepsItsAreaHoweverTheLayersCutIt)
{
  for (const double thickness : {0.07, 0.3, 1.0, 2.5, 40.0})
    for (const double y : {-0.4, 0.0, 0.35, 2.5, 3.3}) {
      const Layers layers(thickness, 1);
      const std::size_t count = layers.at(y + 1) + 1;
      double sum = 0;
      layers.share_grain<2>(y, 1, count, [&](std::size_t n, double area) {
        EXPECT_LT(n, count);
        EXPECT_GE(area, 0);
        sum += area;
      });
      EXPECT_NEAR(sum, pi, 1e-13);
    }
}

TEST(Layers, ASphereKeepsItsVolumeHoweverTheLayersCutIt)
{
  for (const double thickness : {0.07, 0.3, 1.0, 2.5, 40.0})
    for (const double y : {-0.4, 0.0, 0.35, 2.5, 3.3}) {
      const Layers layers(thickness, 1, 1);
      double sum = 0;
      layers.share_grain<3>(y, 1, layers.at(y + 1) + 1, [&](std::size_t, double volume) {
        EXPECT_GE(volume, 0);
        sum += volume;
      });
      EXPECT_NEAR(sum, 4 * pi / 3, 1e-13);
    }
}

// A cap of height h of a sphere of radius r has the volume pi h^2 (3 r - h)/3 (Archimedes).
TEST(Layers, ASphereIsCutWhereTheEdgeIs)
{
  std::vector<double> volumes(3);
  Layers(1, 2, 3).share_grain<3>(1.5, 1, 3,
                                 [&](std::size_t n, double volume) { volumes[n] = volume; });
  const double cap = pi * 0.25 * 2.5 / 3;
  EXPECT_NEAR(volumes[0], cap, 1e-14);
  EXPECT_NEAR(volumes[1], 4 * pi / 3 - 2 * cap, 1e-14);
  EXPECT_NEAR(volumes[2], cap, 1e-14);
}

TEST(Layers, InSpaceHaveTheirAreaTimesTheirThickness)
{
  EXPECT_DOUBLE_EQ(Layers(0.5, 3, 7).volume(4), 10.5);
  EXPECT_DOUBLE_EQ(Layers(0.5, 3, 7).volume_of_bed(2), 42);
  EXPECT_DOUBLE_EQ(Layers::annuli(0.5, 3, {1, 1}, 7).volume(2), 7 * pi * 0.25 * 5);
  EXPECT_THROW(Layers(0.5, 3, 0.0), UsageError);
  const auto round = Layers::annuli(0.5, 3, {1, 1}, 7);
  EXPECT_DOUBLE_EQ(round.height<3>({4, 5, 99}), 5);
  // Outward is (0.6, 0.8, 0); the second axis is clockwise, and z does not change.
  const Vec3 turned = round.turned<3>({0.6, 0.8, 0.5}, {4, 5, 99});
  EXPECT_NEAR((turned - Vec3(0, 1, 0.5)).norm(), 0, 1e-15);
}

TEST(Layers, ADiscIsCutWhereTheEdgeIs)
{
  std::vector<double> areas(3);
  Layers(1, 1).share_grain<2>(1.5, 1, 3, [&](std::size_t n, double area) { areas[n] = area; });
  const double cap = pi / 3 - std::sqrt(3) / 4;
  EXPECT_NEAR(areas[0], cap, 1e-14);
  EXPECT_NEAR(areas[1], pi - 2 * cap, 1e-14);
  EXPECT_NEAR(areas[2], cap, 1e-14);
}

TEST(Layers, ASegmentIsSharedByLengthWhicheverWayItRuns)
{
  const Layers layers(1, 1);
  for (const bool up : {true, false}) {
    std::vector<double> shares(4);
    layers.share_segment(up ? 0.5 : 2.5, up ? 2.5 : 0.5, 4,
                         [&](std::size_t n, double share) { shares[n] += share; });
    EXPECT_EQ(shares, (std::vector<double>{0.25, 0.5, 0.25, 0}));
  }
}

TEST(Layers, ALevelSegmentIsWhole)
{
  double sum = 0;
  Layers(1, 1).share_segment(2, 2, 4, [&](std::size_t n, double share) {
    EXPECT_EQ(n, 2u);
    sum += share;
  });
  EXPECT_EQ(sum, 1);
}

TEST(Layers, WhatLiesBelowTheBaseGoesToTheFirstLayerAndAboveToTheLast)
{
  std::vector<double> shares(2);
  Layers(1, 1).share_segment(-1, 3, 2, [&](std::size_t n, double share) { shares[n] += share; });
  EXPECT_EQ(shares, (std::vector<double>{0.5, 0.5}));
}

// Two unit circles through each other's centres share two segments of 120 degrees.
TEST(Annuli, ADiscAndACircleShareTheirTwoSegments)
{
  EXPECT_NEAR(disc_area_within(1, 1, 1), 2 * pi / 3 - std::sqrt(3) / 2, 1e-15);
  EXPECT_DOUBLE_EQ(disc_area_within(1, 0.5, 2), pi);
  EXPECT_DOUBLE_EQ(disc_area_within(2, 0.5, 1), pi);
  EXPECT_EQ(disc_area_within(1, 3, 1.5), 0);
  // A large circle through the centre halves the disc, except for its curvature y^2/(2 R).
  EXPECT_NEAR(disc_area_within(1, 1e4, 1e4), pi / 2 - 1 / 3e4, 1e-10);
}

TEST(Annuli, ADiscAboutTheAxisFillsAnnuliFromTheInside)
{
  const auto annuli = Layers::annuli(1, 10, {5, 5});
  std::vector<double> areas(3);
  annuli.share_grain<2>(0, 2.5, 3, [&](std::size_t n, double area) { areas[n] = area; });
  EXPECT_NEAR(areas[0], pi, 1e-14);
  EXPECT_NEAR(areas[1], 3 * pi, 1e-14);
  EXPECT_NEAR(areas[2], 2.25 * pi, 1e-14);
}

TEST(Annuli, ADiscKeepsItsAreaHoweverTheAnnuliCutIt)
{
  for (const double thickness : {0.07, 0.3, 1.0, 2.5, 40.0})
    for (const double distance : {0.0, 0.4, 1.0, 2.5, 33.3}) {
      const auto annuli = Layers::annuli(thickness, 1, {0, 0});
      double sum = 0;
      annuli.share_grain<2>(distance, 1, annuli.at(distance + 1) + 1,
                            [&](std::size_t, double area) {
                              EXPECT_GE(area, -1e-12);
                              sum += area;
                            });
      EXPECT_NEAR(sum, pi, 1e-11);
    }
}

TEST(Annuli, VolumesAddUpToADisc)
{
  const auto annuli = Layers::annuli(0.3, 1, {0, 0});
  double sum = 0;
  for (std::size_t n = 0; n < 7; ++n) sum += annuli.volume(n);
  EXPECT_NEAR(sum, pi * 2.1 * 2.1, 1e-13);
}

TEST(Annuli, AcrossIsOutwardAndAlongIsClockwise)
{
  const auto annuli = Layers::annuli(1, 10, {5, 5});
  EXPECT_EQ(annuli.height<2>({8, 9}), 5);
  EXPECT_EQ(annuli.turned<2>({2, 3}, {5, 7}), Vec2(2, 3));    // above the axis, as over a base
  EXPECT_EQ(annuli.turned<2>({2, 3}, {5, 1}), Vec2(-2, -3));  // below the axis
  EXPECT_EQ(annuli.turned<2>({2, 3}, {6, 5}), Vec2(-3, 2));   // right of the axis
  EXPECT_EQ(Layers(1, 10).turned<2>({2, 3}, {6, 5}), Vec2(2, 3));
}

TEST(Annuli, TheyReachToTheFarthestMobileGrain)
{
  Packing packing;
  packing.grain(Species::boundary, 1, {50, 5});
  packing.grain(Species::small, 0.5, {5, 1.75});
  EXPECT_EQ(Layers::annuli(1, 10, {5, 5}).count(packing.grains, packing.frame), 4u);
  packing.frame.position[1].x() = 6;
  EXPECT_EQ(Layers::annuli(1, 10, {5, 5}).count(packing.grains, packing.frame), 4u);
  packing.frame.position[1].x() = 9;
  EXPECT_EQ(Layers::annuli(1, 10, {5, 5}).count(packing.grains, packing.frame), 6u);
}

TEST(Layers, ThicknessAndLengthMustBePositive)
{
  EXPECT_THROW(Layers(0, 1), UsageError);
  EXPECT_THROW(Layers(-1, 1), UsageError);
  EXPECT_THROW(Layers(std::nan(""), 1), UsageError);
  EXPECT_THROW(Layers(1, 0), UsageError);
}

}  // namespace
}  // namespace grseg
