// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes drawn of a frame: discs, lines of contacts and the points where they are split, walls.
#include "analysis/render/drawing.hpp"

#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace grseg {
namespace {

const Colour fine = rgb(0x000001), coarse = rgb(0x000002), base = rgb(0x000003),
             nobody = rgb(0x000004), plain = rgb(0x000005);

DrawingStyle style_of(std::optional<PartitionRule> rule)
{
  DrawingStyle style;
  style.grains = {{fine, coarse}, base, std::nullopt};
  style.lines = LineStyle{0.5, rule, {fine, coarse}, plain, nobody};
  return style;
}

/// View of a cell of length 10 and height 5.
View view_of(bool periodic)
{
  View view(Plane::xy, {.length_x = 10, .length_y = 5, .periodic_x = periodic});
  view.region = {{0, 0}, {10, 5}};
  return view;
}

Drawing draw(const Packing& packing, const DrawingStyle& style, bool periodic = false)
{
  return draw_frame<2>(packing.grains, packing.frame, {}, {}, view_of(periodic), style);
}

/// A large grain of radius 1 and a small one of radius 0.5 that overlap by 0.1. The branch has length
/// 1.4, of which 0.95 is between the large grain's centre and the contact point.
Packing mixed_pair(bool large_first)
{
  Packing packing;
  const auto large = packing.grain(Species::large, 1, {4, 2});
  const auto small = packing.grain(Species::small, 0.5, {5.4, 2});
  if (large_first)
    packing.contact(large, small, {-2, 0});
  else
    packing.contact(small, large, {2, 0});
  return packing;
}

/// Distance from the large grain's centre to the point where the colours of the mixed contact meet.
double split(const PartitionRule& rule, bool large_first)
{
  const auto lines = draw(mixed_pair(large_first), style_of(rule)).lines;
  EXPECT_EQ(lines.size(), 2u);
  const auto& of_large = lines[0].colour == coarse ? lines[0] : lines[1];
  const auto& of_small = lines[0].colour == coarse ? lines[1] : lines[0];
  EXPECT_EQ(of_large.colour, coarse);
  EXPECT_EQ(of_small.colour, fine);
  EXPECT_EQ(of_large.from, Vec2(4, 2));
  EXPECT_EQ(of_small.from, Vec2(5.4, 2));
  EXPECT_NEAR((of_large.to - of_small.to).norm(), 0, 1e-14);
  EXPECT_FALSE(of_large.round_end || of_small.round_end);
  return (of_large.to - of_large.from).norm();
}

TEST(Drawing, AMixedContactIsSplitWhereEachGrainHasItsShare)
{
  using Kind = PartitionRule::Kind;
  for (const bool large_first : {true, false}) {
    EXPECT_NEAR(split({Kind::size}, large_first), 1.4 * 2 / 3, 1e-14);
    EXPECT_NEAR(split({Kind::contact_point}, large_first), 0.95, 1e-14);
    EXPECT_NEAR(split({Kind::half}, large_first), 0.7, 1e-14);
    EXPECT_NEAR(split({Kind::uniform, 0.8}, large_first), 1.12, 1e-14);
    EXPECT_NEAR(split({Kind::power, 2}, large_first), 1.4 * 4 / 5, 1e-14);
  }
}

TEST(Drawing, AMixedContactBelongsToNoSpeciesUnderDrop)
{
  const auto lines =
      draw(mixed_pair(true), style_of(PartitionRule{PartitionRule::Kind::drop})).lines;
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].colour, nobody);
  EXPECT_TRUE(lines[0].round_end);
}

TEST(Drawing, AShareOfOneIsAllOfTheLine)
{
  const auto lines =
      draw(mixed_pair(true), style_of(PartitionRule{PartitionRule::Kind::uniform, 1})).lines;
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].colour, coarse);
  EXPECT_TRUE(lines[0].round_end);
}

// The force (3, 4) on a contact along x has the normal component 3.
TEST(Drawing, TheWidthIsInProportionToTheNormalForce)
{
  Packing packing;
  const auto a = packing.grain(Species::small, 0.5, {3, 2});
  const auto b = packing.grain(Species::small, 0.5, {2, 2});
  packing.contact(a, b, {3, 4});
  const auto lines = draw(packing, style_of(std::nullopt)).lines;
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_DOUBLE_EQ(lines[0].width, 1.5);
  EXPECT_EQ(lines[0].colour, plain);
  EXPECT_EQ(lines[0].from, Vec2(3, 2));
  EXPECT_EQ(lines[0].to, Vec2(2, 2));
}

TEST(Drawing, ContactsWithoutForceOrThatPullAreNotDrawn)
{
  Packing packing;
  const auto a = packing.grain(Species::small, 0.5, {3, 2});
  const auto b = packing.grain(Species::small, 0.5, {2, 2});
  packing.contact(a, b, {0, 0});
  packing.contact(a, b, {-1, 0});
  EXPECT_TRUE(draw(packing, style_of(std::nullopt)).lines.empty());
}

TEST(Drawing, GrainsOfOneSpeciesShareOneLine)
{
  Packing packing;
  const auto a = packing.grain(Species::large, 0.5, {3, 2});
  const auto b = packing.grain(Species::large, 0.5, {2, 2});
  packing.contact(a, b, {3, 0});
  const auto lines = draw(packing, style_of(PartitionRule{})).lines;
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].colour, coarse);
}

TEST(Drawing, TheFarPartOfABoundaryContactBelongsToNoSpecies)
{
  Packing packing;
  const auto grain = packing.grain(Species::small, 0.5, {3, 2.5});
  const auto bead = packing.grain(Species::boundary, 1, {3, 1});
  packing.contact(grain, bead, {0, 2});
  const auto lines = draw(packing, style_of(PartitionRule{})).lines;
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].colour, nobody);  // drawn under the other line
  EXPECT_EQ(lines[0].to, Vec2(3, 1));
  EXPECT_EQ(lines[1].colour, fine);
  EXPECT_NEAR(lines[1].to.y(), 2, 1e-14);
}

TEST(Drawing, AContactAcrossThePeriodIsDrawnAtBothEndsAndNotThroughTheCell)
{
  Packing packing;
  const auto left = packing.grain(Species::small, 0.5, {0.25, 2});
  const auto right = packing.grain(Species::small, 0.5, {9.25, 2});
  packing.image_contact(left, right, {1, 0}, {1, 0});
  const auto drawing = draw(packing, style_of(std::nullopt), true);
  ASSERT_EQ(drawing.lines.size(), 2u);
  for (const auto& line : drawing.lines) EXPECT_NEAR((line.to - line.from).norm(), 1, 1e-14);
  EXPECT_EQ(drawing.lines[0].from, Vec2(0.25, 2));
  EXPECT_EQ(drawing.lines[0].to, Vec2(-0.75, 2));
  EXPECT_EQ(drawing.lines[1].from, Vec2(10.25, 2));
  EXPECT_EQ(drawing.lines[1].to, Vec2(9.25, 2));
  ASSERT_EQ(drawing.discs.size(), 3u);  // the end of the cell cuts the left one
  EXPECT_EQ(drawing.discs[1].centre, Vec2(10.25, 2));
}

TEST(Drawing, BoundaryGrainsLieBelowAndHaveTheirColour)
{
  Packing packing;
  packing.grain(Species::small, 0.5, {3, 2});
  packing.grain(Species::boundary, 1, {3, 1});
  packing.grain(Species::large, 1, {6, 2});
  const auto discs = draw(packing, style_of(std::nullopt)).discs;
  ASSERT_EQ(discs.size(), 3u);
  EXPECT_EQ(discs[0].colour, base);
  EXPECT_EQ(discs[1].colour, fine);
  EXPECT_EQ(discs[2].colour, coarse);
  EXPECT_EQ(discs[2].radius, 1);
}

TEST(Drawing, AbsentGrainsAreNotDrawn)
{
  Packing packing;
  packing.grain(Species::small, 0.5, {3, 2});
  packing.grain(Species::small, 0.5, {4, 2});
  packing.frame.image.resize(2);
  packing.frame.force.resize(2);
  make_absent(packing.frame, 0);
  const auto discs = draw(packing, style_of(std::nullopt)).discs;
  ASSERT_EQ(discs.size(), 1u);
  EXPECT_EQ(discs[0].centre, Vec2(4, 2));
}

TEST(Drawing, AFieldColoursMobileGrainsThatHaveANumber)
{
  Packing packing;
  packing.grain(Species::small, 0.5, {3, 2});
  packing.grain(Species::large, 0.5, {4, 2});
  packing.grain(Species::boundary, 0.5, {4, 1});
  auto style = style_of(std::nullopt);
  style.grains.scale = ColourScale{};
  const auto discs =
      draw_frame<2>(packing.grains, packing.frame, {1, std::numeric_limits<double>::quiet_NaN(), 1},
                    {}, view_of(false), style)
          .discs;
  ASSERT_EQ(discs.size(), 3u);
  EXPECT_EQ(discs[0].colour, base);
  EXPECT_EQ(discs[1].colour, viridis(1));
  EXPECT_EQ(discs[2].colour, base);
}

// A grain of radius 0.5 at x = 0.5 leans on a wall at x = 0.
TEST(Drawing, AWallLiesWhereGrainsTouchIt)
{
  Packing packing;
  const auto grain = packing.grain(Species::small, 0.5, {0.5, 2});
  packing.wall_contact(grain, 0, {1, 0}, {0.5, 0});
  const auto drawing = draw(packing, style_of(PartitionRule{}));
  ASSERT_EQ(drawing.walls.size(), 1u);
  EXPECT_EQ(drawing.walls[0].point, Vec2(0, 2));
  EXPECT_EQ(drawing.walls[0].normal, Vec2(1, 0));
  ASSERT_EQ(drawing.lines.size(), 1u);  // all of the line is the grain's
  EXPECT_EQ(drawing.lines[0].to, Vec2(0, 2));
  EXPECT_EQ(drawing.lines[0].colour, fine);
}

TEST(Drawing, AWallIsRememberedWhenNothingTouchesIt)
{
  Packing packing;
  const auto grain = packing.grain(Species::small, 0.5, {0.5, 2});
  packing.wall_contact(grain, 3, {1, 0}, {0.5, 0});
  Walls<2> walls;
  walls.add(packing.frame);
  packing.frame.contacts.clear();
  const auto drawing = draw_frame<2>(packing.grains, packing.frame, {}, walls, view_of(false),
                                     style_of(std::nullopt));
  ASSERT_EQ(drawing.walls.size(), 1u);
  EXPECT_EQ(drawing.walls[0].point, Vec2(0, 2));
}

PackingOf<3> three_spheres()
{
  PackingOf<3> packing;
  packing.grain(Species::small, 0.5, {1, 1, 3});
  packing.grain(Species::small, 0.5, {1, 1, 2});
  packing.grain(Species::large, 0.5, {1, 1, 1});
  packing.contact(0, 1, {0, 0, 1});
  packing.contact(1, 2, {0, 0, 1});
  packing.wall_contact(2, 0, {0, 0, 1}, {0, 0, 0.5});  // the wall is parallel to the picture
  packing.wall_contact(2, 1, {0, 1, 0}, {0, 0.5, 0});
  return packing;
}

View view_3d()
{
  View view(Plane::xy, {.length_x = 10, .length_y = 5, .periodic_x = false, .dimension = 3});
  view.region = {{0, 0}, {10, 5}};
  return view;
}

TEST(Drawing, NearerSpheresComeLater)
{
  const auto packing = three_spheres();
  const auto discs =
      draw_frame<3>(packing.grains, packing.frame, {}, {}, view_3d(), style_of(std::nullopt)).discs;
  ASSERT_EQ(discs.size(), 3u);
  EXPECT_EQ(discs[0].colour, coarse);
  EXPECT_EQ(discs[2].colour, fine);
}

TEST(Drawing, ASlabShowsItsCentresAndItsContactPoints)
{
  const auto packing = three_spheres();
  auto view = view_3d();
  view.slab = Range{0.75, 1.75};  // large grain, its contact at 1.5, and the contact with wall 1
  const auto drawing =
      draw_frame<3>(packing.grains, packing.frame, {}, {}, view, style_of(std::nullopt));
  EXPECT_EQ(drawing.discs.size(), 1u);
  EXPECT_EQ(drawing.lines.size(), 2u);
}

TEST(Drawing, OnlyWallsThatStandOnThePictureAreLines)
{
  const auto packing = three_spheres();
  const auto walls =
      draw_frame<3>(packing.grains, packing.frame, {}, {}, view_3d(), style_of(std::nullopt)).walls;
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_EQ(walls[0].normal, Vec2(0, 1));
  EXPECT_EQ(walls[0].point, Vec2(1, 0.5));
}

}  // namespace
}  // namespace grseg
