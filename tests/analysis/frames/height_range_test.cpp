// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/height_range.hpp"

#include "formats/core/errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

const LengthUnits units{0.005, 0.01};

TEST(HeightRange, ReadsBothEndsInTheirUnits)
{
  const auto range = parse_heights("4dS:56dS", units);
  EXPECT_DOUBLE_EQ(range.lowest, 0.02);
  EXPECT_DOUBLE_EQ(range.highest, 0.28);
}

TEST(HeightRange, IsOpenWhereAnEndIsLeftOut)
{
  EXPECT_TRUE(std::isinf(parse_heights("1dL:", units).highest));
  EXPECT_DOUBLE_EQ(parse_heights("1dL:", units).lowest, 0.01);
  EXPECT_TRUE(std::isinf(parse_heights(":30mm", units).lowest));
  EXPECT_DOUBLE_EQ(parse_heights(":30mm", units).highest, 0.03);
  EXPECT_TRUE(std::isinf(parse_heights("", units).lowest));
}

TEST(HeightRange, RefusesASingleHeightAndWhatIsNotALength)
{
  EXPECT_THROW(parse_heights("4dS", units), UsageError);
  EXPECT_THROW(parse_heights("low:4dS", units), UsageError);
}

// 0.28 is not a multiple of 0.02 to the last digit.
TEST(HeightRange, HoldsLayersThatReachItsEndsExactlyAndTheWholeBed)
{
  const HeightRange range{0.02, 0.28};
  EXPECT_TRUE(range.holds(0.02, 0.04));
  EXPECT_TRUE(range.holds(13 * 0.02, 14 * 0.02));
  EXPECT_FALSE(range.holds(0, 0.02));
  EXPECT_FALSE(range.holds(0.27, 0.29));
  EXPECT_TRUE(range.holds(std::nan(""), std::nan("")));
}

}  // namespace
}  // namespace grseg
