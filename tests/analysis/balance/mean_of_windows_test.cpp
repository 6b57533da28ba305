// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/balance_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

// Values 1, 2 and 3 have the variance 1, so the standard error of their mean is 1/sqrt(3).
TEST(MeanOfWindows, HasTheStandardErrorOfIndependentWindows)
{
  const auto [mean, error] = mean_of_windows({1, 2, 3});
  EXPECT_DOUBLE_EQ(mean, 2);
  EXPECT_DOUBLE_EQ(error, 1 / std::sqrt(3.0));
  EXPECT_EQ(errors_over({1, 2, 3}), "standard errors over 3 windows");
}

TEST(MeanOfWindows, HasNoErrorWhereNothingMovesOrThereIsOneWindow)
{
  for (const auto& still :
       {std::vector<double>{0.31, 0.31 + 1e-9, 0.31}, {0, 0, 0}, {-2, -2}, {0.31}}) {
    EXPECT_NEAR(mean_of_windows(still).mean, still[0], 1e-9);
    EXPECT_TRUE(std::isnan(mean_of_windows(still).error));
  }
  EXPECT_EQ(errors_over({-2, -2}), "of 2 identical windows: no error can be given");
  EXPECT_EQ(errors_over({0.31}), "of one window");
}

}  // namespace
}  // namespace grseg
