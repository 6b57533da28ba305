// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/layer_key.hpp"
#include "formats/core/errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

const LengthUnits units{0.005, 0.01};

TEST(HeightRange, ReadsBothEndsInTheirUnits)
{
  const auto range = parse_heights("4dS:56dS", units, {});
  EXPECT_DOUBLE_EQ(range.lowest, 0.02);
  EXPECT_DOUBLE_EQ(range.highest, 0.28);
}

TEST(HeightRange, IsOpenWhereAnEndIsLeftOut)
{
  EXPECT_TRUE(std::isinf(parse_heights("1dL:", units, {}).highest));
  EXPECT_DOUBLE_EQ(parse_heights("1dL:", units, {}).lowest, 0.01);
  EXPECT_TRUE(std::isinf(parse_heights(":30mm", units, {}).lowest));
  EXPECT_DOUBLE_EQ(parse_heights(":30mm", units, {}).highest, 0.03);
  EXPECT_TRUE(std::isinf(parse_heights("all", units, {}).lowest));
}

TEST(HeightRange, RefusesASingleHeightAndWhatIsNotALength)
{
  for (const char* wrong : {"4dS", "low:4dS", "", "outside", "4:8"})
    EXPECT_THROW(check_heights(wrong), UsageError) << wrong;
}

LayerSolid filled_layer(double bottom, double frames, double solid)
{
  return {{.bottom = bottom, .top = bottom + 0.02, .frames = frames}, solid};
}

// A bed that starts at -0.02 m: four layers of solid fraction 0.8, one of 0.6 on average, spray of
// 0.1. Its surface is at -0.02 + 0.02 (4 + 0.75 + 0.125) = 0.0775 m; 4 d_S are 0.02 m.
TEST(HeightRange, InsideLeavesFourSmallDiametersAtTheBaseAndUnderTheSurface)
{
  std::vector<LayerSolid> layers;
  for (int k = -1; k < 3; ++k)
    for (int window = 0; window < 3; ++window) layers.push_back(filled_layer(0.02 * k, 10, 0.8));
  layers.push_back(filled_layer(0.06, 30, 0.7));
  layers.push_back(filled_layer(0.06, 10, 0.3));
  layers.push_back(filled_layer(0.08, 10, 0.1));
  layers.push_back(filled_layer(0.10, 0, 0));
  const auto range = parse_heights("inside", units, layers);
  EXPECT_NEAR(range.lowest, 0, 1e-12);
  EXPECT_NEAR(range.highest, 0.0575, 1e-12);
  EXPECT_FALSE(parse_heights("inside", units, {}).holds(0, 0.02));
}

// Two layers below the bed hold a few grains that fell through: 0.1 of 0.8 each.
TEST(HeightRange, InsideBeginsAboveTheBaseAndNotAtTheBottomOfTheCell)
{
  std::vector<LayerSolid> layers;
  for (int k = 0; k < 12; ++k) layers.push_back(filled_layer(0.02 * k, 10, k < 2 ? 0.08 : 0.8));
  const auto range = parse_heights("inside", units, layers);
  EXPECT_NEAR(range.lowest, 0.04 + 0.02, 1e-12);
}

// In floating point, 35 * 0.02 exceeds 0.7 in the last digit.
TEST(HeightRange, HoldsLayersThatReachItsEndsExactlyAndTheWholeBed)
{
  const HeightRange range{0.02, 0.7};
  EXPECT_TRUE(range.holds(0.02, 0.04));
  EXPECT_TRUE(range.holds(34 * 0.02, 35 * 0.02));
  EXPECT_FALSE(range.holds(0, 0.02));
  EXPECT_FALSE(range.holds(0.69, 0.71));
  EXPECT_TRUE(range.holds(std::nan(""), std::nan("")));
}

TEST(MedianSolid, LeavesOutWhatIsEmptyOrNotANumber)
{
  const auto median = [](const std::vector<double>& solid) {
    std::vector<LayerSolid> layers;
    for (const double one : solid) layers.push_back({{}, one});
    return median_solid(layers);
  };
  EXPECT_EQ(median({0, 3, 0, 1, 2, 0, 0, std::nan("")}), 2);
  EXPECT_EQ(median({0, 3, 1}), 2);  // half way between the two
  EXPECT_EQ(median({0, 0}), 0);
  EXPECT_EQ(median({}), 0);
}

}  // namespace
}  // namespace grseg
