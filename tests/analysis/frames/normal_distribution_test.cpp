// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/coarse_graining.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace grseg {
namespace {

long double density(long double u)
{
  return std::exp(-u * u / 2) / std::sqrt(2 * std::numbers::pi_v<long double>);
}

/// The continued fraction 1/(v + 2/(v + 3/(v + ...))), with Phi(-v) = phi(v)/(v + fraction) for v >
/// 0 (Abramowitz & Stegun 1964, 26.2.14). It loses no digits.
long double fraction(long double v)
{
  long double rest = 0;
  for (int n = 400; n > 0; --n) rest = static_cast<long double>(n) / (v + rest);
  return rest;
}
long double exact_below(long double u)
{
  if (u < -2) return density(u) / (fraction(-u) - u);
  return std::erfc(-u / std::numbers::sqrt2_v<long double>) / 2;
}
long double exact_primitive(long double u)
{
  if (u < -2) return density(u) * fraction(-u) / (fraction(-u) - u);
  return u * exact_below(u) + density(u);
}

/// Error bound that the header states.
double bound(double u)
{
  return u < -10 ? 1e-19 * u * u * u * u : 1e-15;
}

// Arguments: points of the series, midpoints, other numbers, and numbers beyond the end of the series.
TEST(NormalDistribution, IsThatOfTheErrorFunctionInItsTailsToo)
{
  for (double u = -30; u <= 9; u += 1.0 / 512)
    EXPECT_LE(std::abs(normal_below(u) / exact_below(u) - 1), bound(u)) << u;
}

TEST(NormalDistribution, ThePrimitiveKeepsTheDigitsThatItsClosedFormLoses)
{
  for (double u = -30; u <= 9; u += 1.0 / 512)
    EXPECT_LE(std::abs(normal_below_primitive(u) / exact_primitive(u) - 1), bound(u)) << u;
  const double u = -8.3, phi = std::exp(-u * u / 2) / std::sqrt(2 * std::numbers::pi);
  EXPECT_GT(std::abs((u * normal_below(u) + phi) / exact_primitive(u) - 1), bound(u));
}

TEST(NormalDistribution, HasItsKnownValuesAndLimits)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(normal_below(0), 0.5);
  EXPECT_NEAR(normal_below(-1.959963984540054), 0.025, 1e-16);
  EXPECT_NEAR(normal_below_primitive(0), 1 / std::sqrt(2 * std::numbers::pi), 1e-16);
  EXPECT_EQ(normal_below_primitive(40), 40);
  EXPECT_EQ(normal_below(-infinity), 0);
  EXPECT_EQ(normal_below(infinity), 1);
  EXPECT_TRUE(std::isnan(normal_below(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace grseg
