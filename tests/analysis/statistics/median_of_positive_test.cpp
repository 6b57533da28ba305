// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/median_of_positive.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

TEST(MedianOfPositive, LeavesOutWhatIsEmptyOrNotANumber)
{
  EXPECT_EQ(median_of_positive({0, 3, 0, 1, 2, 0, 0, std::nan("")}), 2);
  EXPECT_EQ(median_of_positive({0, 3, 1}), 2);  // half way between the two
  EXPECT_EQ(median_of_positive({0, 0}), 0);
  EXPECT_EQ(median_of_positive({}), 0);
}

}  // namespace
}  // namespace grseg
