// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers and colours of a picture's legend.
#include "analysis/render/round_numbers.hpp"

#include "analysis/render/colours.hpp"
#include "analysis/render/drawing.hpp"
#include "analysis/render/survey.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using Texts = std::vector<std::string>;

TEST(RoundNumbers, AreOneTwoOrFiveTimesAPowerOfTen)
{
  EXPECT_DOUBLE_EQ(round_below(0.99), 0.5);
  EXPECT_DOUBLE_EQ(round_below(1), 1);
  EXPECT_DOUBLE_EQ(round_below(4.99), 2);
  EXPECT_DOUBLE_EQ(round_below(0.0203), 0.02);
  EXPECT_DOUBLE_EQ(round_below(7e-9), 5e-9);
  EXPECT_DOUBLE_EQ(round_above(0.51), 1);
  EXPECT_DOUBLE_EQ(round_above(0.2), 0.2);
  EXPECT_DOUBLE_EQ(round_above(2001), 5000);
}

TEST(RoundNumbers, RoundOffMovesNoNumberAcross)
{
  EXPECT_DOUBLE_EQ(round_above(0.1 + 0.2 - 0.1), 0.2);  // a little more than 0.2
  EXPECT_DOUBLE_EQ(round_below(0.7 - 0.2), 0.5);        // a little less than 0.5
}

TEST(RoundNumbers, ARangeIsWidenedToMultiplesOfAStep)
{
  const auto range = round_range({0.13, 2.44});  // a sixth of its length is 0.385: step 0.5
  EXPECT_DOUBLE_EQ(range.low, 0);
  EXPECT_DOUBLE_EQ(range.high, 2.5);
  const auto round = round_range({-0.2, 0.4});
  EXPECT_DOUBLE_EQ(round.low, -0.2);
  EXPECT_DOUBLE_EQ(round.high, 0.4);
}

TEST(RoundNumbers, ARangeWithoutLengthGetsOne)
{
  EXPECT_EQ(round_range({0, 0}).low, 0);
  EXPECT_EQ(round_range({0, 0}).high, 1);
  EXPECT_EQ(round_range({-4, -4}).low, -6);
  EXPECT_EQ(round_range({-4, -4}).high, -2);
}

TEST(RoundNumbers, TicksLieInTheRangeAndHaveTheDecimalsOfTheirStep)
{
  EXPECT_EQ(tick_labels(ticks({0, 1})), (Texts{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(tick_labels(ticks({-0.1, 0.1}, 5)), (Texts{"-0.10", "-0.05", "0.00", "0.05", "0.10"}));
  EXPECT_EQ(tick_labels(ticks({0, 2.5})), (Texts{"0.0", "0.5", "1.0", "1.5", "2.0", "2.5"}));
  EXPECT_EQ(tick_labels(ticks({0, 3000}, 4)), (Texts{"0", "1000", "2000", "3000"}));
  EXPECT_EQ(tick_labels(ticks({0, 2e-6}, 3)), (Texts{"0", "1e-06", "2e-06"}));
}

TEST(RoundNumbers, LabelsOfANarrowRangeDiffer)
{
  EXPECT_EQ(tick_labels(ticks({0.01, 0.0101}, 3)), (Texts{"0.01000", "0.01005", "0.01010"}));
  EXPECT_EQ(tick_labels(ticks({2e-6, 2.002e-6}, 3)), (Texts{"2e-06", "2.001e-06", "2.002e-06"}));
  EXPECT_EQ(tick_labels(ticks({1e6, 1000002}, 3)), (Texts{"1000000", "1000001", "1000002"}));
}

TEST(RoundNumbers, LengthsHaveTheUnitThatFits)
{
  EXPECT_EQ(length_text(0.005), "5 mm");
  EXPECT_EQ(length_text(0.01), "1 cm");
  EXPECT_EQ(length_text(0.5), "50 cm");
  EXPECT_EQ(length_text(2), "2 m");
  EXPECT_EQ(lengths_text({0, 0.01}), "0 to 1 cm");
  EXPECT_EQ(lengths_text({-0.002, 0.001}), "-2 to 1 mm");
}

// Values 0 to 100: the 99th of a hundred steps is 99.
TEST(FieldRange, LeavesOutTheLastHundredth)
{
  std::vector<double> values;
  for (int k = 0; k <= 100; ++k) values.push_back(k == 100 ? 1e6 : k);
  const auto range = range_of(FieldEnds::zero_to_most, values);
  EXPECT_EQ(range.low, 0);
  EXPECT_EQ(range.high, 100);  // 99, and the step is 20
  for (double& value : values) value = -value;
  const auto both = range_of(FieldEnds::both_signs, values);
  EXPECT_EQ(both.low, -100);
  EXPECT_EQ(both.high, 100);
  EXPECT_EQ(strong_force({3, 1, 2}), 3);
  EXPECT_EQ(strong_force({}), 0);
}

TEST(Colours, MapsBeginAndEndWhereTheyShouldAndHoldBeyond)
{
  EXPECT_EQ(viridis(0), rgb(0x440154));
  EXPECT_EQ(viridis(1), rgb(0xfde725));
  EXPECT_EQ(viridis(-3), viridis(0));
  EXPECT_EQ(viridis(7), viridis(1));
  EXPECT_EQ(blue_white_red(0.5), rgb(0xf2f2f2));
}

// matplotlib's viridis at 64/255 and 128/255 is 3b528b and 21918c.
TEST(Colours, ViridisIsMatplotlibsWithinThreeSteps)
{
  const auto near = [](const Colour& a, const Colour& b) {
    return std::abs(a.red - b.red) <= 3.0 / 255 && std::abs(a.green - b.green) <= 3.0 / 255 &&
           std::abs(a.blue - b.blue) <= 3.0 / 255;
  };
  EXPECT_TRUE(near(viridis(64 / 255.0), rgb(0x3b528b)));
  EXPECT_TRUE(near(viridis(128 / 255.0), rgb(0x21918c)));
}

TEST(Colours, SmallAndLargeAreThoseOfOkabeAndIto)
{
  EXPECT_EQ(species_colours(0, 2).grain, rgb(0x56b4e9));
  EXPECT_EQ(species_colours(1, 2).grain, rgb(0xd55e00));
}

TEST(Colours, ManySpeciesAllDiffer)
{
  for (std::size_t a = 0; a < 12; ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_FALSE(species_colours(a, 12).grain == species_colours(b, 12).grain) << a << ' ' << b;
}

TEST(Colours, AScaleGoesFromEndToEndOfItsRange)
{
  ColourScale scale;
  scale.range = {2, 6};
  EXPECT_EQ(scale.at(2), viridis(0));
  EXPECT_EQ(scale.at(5), viridis(0.75));
  EXPECT_EQ(scale.at(100), viridis(1));
  scale.pale = {1, 1, 1};
  scale.paleness = 1;
  EXPECT_EQ(scale.at(5), rgb(0xffffff));
}

}  // namespace
}  // namespace grseg
