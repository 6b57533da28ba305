// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/player_data.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

TEST(Quantisation, ANumberDiffersFromItsCodeByHalfAStepAtMost)
{
  const Quantisation q(-0.3, 0.7);
  EXPECT_DOUBLE_EQ(q.step(), 1.0 / 65534);
  for (int k = 0; k <= 1000; ++k) {
    const double value = -0.3 + 0.001 * k;
    const double back = q.from() + q.code(value) * q.step();
    EXPECT_NEAR(back, value, 0.5 * q.step() * (1 + 1e-9));
  }
}

TEST(Quantisation, BoundsHaveTheFirstCodeAndTheLast)
{
  const Quantisation q(2, 3);
  EXPECT_EQ(q.code(2), 0);
  EXPECT_EQ(q.code(3), Quantisation::last);
  EXPECT_EQ(q.code(1.9), 0);
  EXPECT_EQ(q.code(3.1), Quantisation::last);
}

TEST(Quantisation, WhatIsNotANumberHasACodeOfItsOwnAndMovesNoBound)
{
  Quantisation q;
  q.include(NAN);
  EXPECT_EQ(q.from(), 0);
  EXPECT_EQ(q.to(), 0);
  q.include(5);
  q.include(NAN);
  q.include(-1);
  EXPECT_EQ(q.from(), -1);
  EXPECT_EQ(q.to(), 5);
  EXPECT_EQ(q.code(NAN), Quantisation::none);
}

TEST(Quantisation, NumbersThatAreAllTheSameNeedNoStep)
{
  Quantisation q;
  q.include(7);
  EXPECT_EQ(q.code(7), 0);
  EXPECT_EQ(q.from() + q.code(7) * q.step(), 7);
}

}  // namespace
}  // namespace grseg
