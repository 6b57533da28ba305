// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/least_squares.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

TEST(LeastSquares, AreThoseOfALineThroughThreePoints)
{
  Eigen::MatrixXd a(3, 2);
  a << 1, 0, 1, 1, 1, 2;
  // y = 1, 3, 2 at 0, 1, 2: the mean is 2, the slope 1/2.
  const LeastSquares line(a);
  const auto x = line.solve(Eigen::Vector3d(1, 3, 2));
  EXPECT_EQ(line.rank(), 2);
  EXPECT_NEAR(x[0], 1.5, 1e-14);
  EXPECT_NEAR(x[1], 0.5, 1e-14);
}

TEST(LeastSquares, AreTheShortestWhereColumnsDependOnEachOther)
{
  Eigen::MatrixXd a(2, 2);
  a << 1, 2, 2, 4;
  // x + 2 y = 5 is true on a line, whose point nearest to the origin is (1, 2).
  const LeastSquares dependent(a, 1e-6);
  const auto x = dependent.solve(Eigen::Vector2d(5, 10));
  EXPECT_EQ(dependent.rank(), 1);
  EXPECT_NEAR(x[0], 1, 1e-14);
  EXPECT_NEAR(x[1], 2, 1e-14);
}

TEST(LeastSquares, TakeForDependentWhatDiffersByLessThanTheThreshold)
{
  Eigen::MatrixXd a(2, 2);
  a << 1, 1, 1, 1 + 1e-8;
  EXPECT_EQ(LeastSquares(a, 1e-6).rank(), 1);
  EXPECT_EQ(LeastSquares(a).rank(), 2);
}

}  // namespace
}  // namespace grseg
