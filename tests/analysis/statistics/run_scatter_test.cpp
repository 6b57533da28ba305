// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/confidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

Eigen::VectorXd list(std::initializer_list<double> values)
{
  Eigen::VectorXd all(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), all.begin());
  return all;
}

// A deviation that all runs of a mixture share, because the mixture differs from others, is not
// scatter of runs.
TEST(RunScatter, IsAboutWhatARunLikeItsMixtureWouldAdd)
{
  const auto weight = list({1, 1, 1, 1});
  const auto alone = deviation_of_runs(list({-1.5, -0.5, 0.5, 1.5}) / 4, weight).error();
  const auto shifted = deviation_of_runs(list({8.5, 9.5, 10.5, 11.5}) / 4, weight).error();
  EXPECT_NEAR(alone.error, std::sqrt(5.0 / 12), 1e-15);
  EXPECT_NEAR(shifted.error, alone.error, 1e-14);
  const auto in_proportion = deviation_of_runs(list({0.2, 0.4}), list({1, 2})).error();
  EXPECT_NEAR(in_proportion.error, 0, 1e-15);
  EXPECT_NEAR(in_proportion.degrees, 9.0 / 5 - 1, 1e-15);
}

TEST(RunScatter, ErrorsAddUpInSquaresWithDegreesBetweenThoseOfOnePartAndOfAll)
{
  const auto one = added({{2, 3}});
  EXPECT_NEAR(one.error, 2, 1e-15);
  EXPECT_NEAR(one.degrees, 3, 1e-14);
  const auto equal = added({{3, 5}, {3, 5}});
  EXPECT_NEAR(equal.error, std::sqrt(18), 1e-15);
  EXPECT_NEAR(equal.degrees, 10, 1e-14);  // 2 (5 + 2) - 2 = 12, but there are only 10
  const auto unequal = added({{1, 5}, {std::sqrt(3), 5}});
  EXPECT_NEAR(unequal.degrees, 16 / (1.0 / 7 + 9.0 / 7) - 2, 1e-13);
  EXPECT_NEAR(added({{1, 5}, {1e-9, 1}}).degrees, 5, 1e-12);
  EXPECT_TRUE(std::isnan(added({{1, 5}, {std::nan(""), 0}}).error));
}

}  // namespace
}  // namespace grseg
