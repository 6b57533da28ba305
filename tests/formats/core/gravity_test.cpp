// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

using std::numbers::pi;

const Vec2 level{0, -9.8};

TEST(Gravity, OfAFixedSlopeIsTheSameAtAnyTime)
{
  const Gravity<2> gravity(level);
  for (const double time : {-1.0, 0.0, 1e6}) EXPECT_EQ(gravity.at(time), level);
  EXPECT_EQ(gravity.mean(7, 100, 0.01), level);
}

TEST(Gravity, TurnsDownTheSlopeFromTimeZeroOn)
{
  const Gravity<2> gravity(level, pi / 6);  // 30 degrees per second
  EXPECT_EQ(gravity.at(-1), level);
  EXPECT_LT((gravity.at(1) - 9.8 * Vec2(0.5, -std::sqrt(0.75))).norm(), 1e-14);
  EXPECT_LT((gravity.at(3) - Vec2(9.8, 0)).norm(), 1e-14);
  EXPECT_EQ(gravity.norm(), 9.8);
}

TEST(Gravity, OfManyStepsIsTheMeanOverTheirMiddles)
{
  const Gravity<2> gravity(level, 0.7);
  const double step = 0.013, last = 5.2;
  for (const int steps : {1, 2, 50, 300}) {
    Vec2 sum = Vec2::Zero();
    for (int k = 0; k < steps; ++k) sum += gravity.at(last - k * step);
    EXPECT_LT((gravity.mean(last, steps, step) - sum / steps).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace grseg
