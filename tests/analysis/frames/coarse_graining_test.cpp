// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/coarse_graining.hpp"

#include "formats/core/errors.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

namespace grseg {
namespace {

constexpr double w = 0.4;
const Kernel psi(w);

/// Integral of f from a to b by GSL, split at `kinks`, where f is not smooth.
double quadrature(const std::function<double(double)>& f, double a, double b,
                  std::vector<double> kinks)
{
  struct Free {
    void operator()(gsl_integration_workspace* space) const
    {
      gsl_integration_workspace_free(space);
    }
  };
  gsl_set_error_handler_off();  // GSL would otherwise abort if no more digits can be reached
  const std::unique_ptr<gsl_integration_workspace, Free> space(
      gsl_integration_workspace_alloc(200));
  const auto call = [](double x, void* g) {
    return (*static_cast<const std::function<double(double)>*>(g))(x);
  };
  auto copy = f;
  gsl_function function{call, &copy};
  std::sort(kinks.begin(), kinks.end());
  std::vector<double> ends{a};
  for (const double kink : kinks)
    if (kink > ends.back() && kink < b) ends.push_back(kink);
  ends.push_back(b);
  double sum = 0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    double piece = 0, error = 0;
    gsl_integration_qag(&function, ends[k], ends[k + 1], 0, 2e-14, 200, GSL_INTEG_GAUSS61,
                        space.get(), &piece, &error);
    sum += piece;
  }
  return sum;
}

/// Points at which psi is not smooth, and others at which its value becomes tiny.
const std::vector<double> kinks{-8 * w, -4 * w, -w, 0, w, 4 * w, 8 * w};

/// Lengths of branches, from zero to much longer than the kernel, m.
const std::vector<double> lengths{0,     1e-300, 1e-16, 1e-9, 1e-5, 0.00399,
                                  0.004, 0.05,   0.4,   1,    3,    20};

TEST(CoarseGraining, TheKernelIsAGaussianOfIntegralOneWhoseStandardDeviationIsItsWidth)
{
  EXPECT_NEAR(psi.value(-0.6), std::exp(-1.125) / std::sqrt(2 * std::numbers::pi) / w, 1e-15);
  const auto moment = [&](int n) {
    return quadrature([&](double u) { return std::pow(u, n) * psi.value(u); }, -12 * w, 12 * w,
                      kinks);
  };
  EXPECT_NEAR(moment(0), 1, 1e-12);
  EXPECT_NEAR(std::sqrt(moment(2)), w, 1e-12);
}

TEST(CoarseGraining, WhatLiesBelowIsTheIntegralOfTheKernel)
{
  for (const double u : {-20 * w, -8 * w, -3 * w, -0.999 * w, -0.1 * w, 0.0, 0.7 * w, 2 * w}) {
    const double exact =
        quadrature([&](double v) { return psi.value(v); }, -40 * w, std::min(u, 12 * w), kinks);
    EXPECT_NEAR(psi.below(u), exact, 1e-12 * exact);
    EXPECT_NEAR(psi.below(u) + psi.below(-u), 1, 1e-15);
  }
}

// The tolerance is relative to the integral, also far in the tails.
TEST(CoarseGraining, TheLineIntegralIsThatOfQuadrature)
{
  for (const double length : lengths)
    for (const double y : {-9.0, -3.0, -1.1, -0.41, -0.2, 0.0, 0.003, 0.39, 0.8, 5.0, 24.0}) {
      std::vector<double> kinks_in_s;
      for (const double kink : kinks)
        if (length > 0) kinks_in_s.push_back((y - kink) / length);
      const double exact =
          quadrature([&](double s) { return psi.value(y - s * length); }, 0, 1, kinks_in_s);
      EXPECT_NEAR(psi.along(y, 0, length), exact, 1e-12 * exact) << length << " " << y;
      EXPECT_EQ(psi.along(y, length, 0), psi.along(y, 0, length));
    }
}

TEST(CoarseGraining, ThePartOfABranchBelowAHeightIsTheIntegralOfTheLineIntegral)
{
  for (const double length : {0.0, 1e-9, 0.00399, 0.004, 0.05, 0.4, 3.0, 20.0})
    for (const double y : {-2.0, -0.41, -0.2, 0.0, 0.003, 0.39, 0.8, 5.0}) {
      std::vector<double> all_kinks = kinks;
      for (const double kink : kinks) all_kinks.push_back(kink + length);
      const double exact =
          quadrature([&](double v) { return psi.along(v, 0, length); }, -20 * w, y, all_kinks);
      EXPECT_NEAR(psi.below_along(y, 0, length), exact, 1e-12 * exact) << length << " " << y;
      EXPECT_NEAR(psi.below_along(length - y, length, 0) + psi.below_along(y, 0, length), 1, 1e-15);
    }
}

// There is no jump where the formula switches from a difference to three points, nor as a branch
// becomes horizontal.
TEST(CoarseGraining, LineIntegralsAreSmoothInTheLengthOfTheBranch)
{
  for (const double y : {-2.0, -0.3, 0.0, 0.25, 0.39}) {
    const double level = psi.value(y), switch_at = 0.02 * w;
    for (const double length : {1e-300, 1e-18, 1e-14})
      EXPECT_NEAR(psi.along(y, -length / 2, length / 2), level, 1e-13 * level);
    const double before = psi.along(y, 0, std::nextafter(switch_at, 0.0));
    const double after = psi.along(y, 0, std::nextafter(switch_at, 1.0));
    EXPECT_NEAR(before, after, 1e-13 * after);
  }
}

// Goldhirsch (2010): with the branch integral, the divergence of the stress balances the force density.
TEST(CoarseGraining, TheStressOfABranchDivergesIntoTheKernelsOfItsEnds)
{
  for (const double length : lengths)
    for (const double y : {-1.0, -0.2, 0.1, 0.5, 2.0})
      EXPECT_NEAR(length * psi.along(y, 0.05, 0.05 + length),
                  psi.below(y - 0.05) - psi.below(y - 0.05 - length), 2e-14);
}

double sum_of_shares(const Kernel& psi, const Layers& layers, double from, double to,
                     std::size_t count)
{
  double sum = 0;
  share_kernel(layers, psi, from, to, count, [&](std::size_t n, double share) {
    EXPECT_LT(n, count);
    EXPECT_GE(share, 0);
    sum += share;
  });
  return sum;
}

TEST(CoarseGraining, SharesOfLayersAddUpToOneWhereverTheBranchLies)
{
  for (const double thickness : {0.03, 0.4, 2.0, 50.0})
    for (const double from : {-3.0, -0.3, 0.0, 1.234, 2.0, 3.9})
      for (const double length : {-2.0, -1e-3, 0.0, 1e-12, 0.3, 6.0})
        EXPECT_NEAR(sum_of_shares(psi, Layers(thickness, 1), from, from + length,
                                  Layers(thickness, 1).at(4) + 1),
                    1, 1e-14);
}

TEST(CoarseGraining, TheShareOfALayerIsTheIntegralOfTheFieldOverIt)
{
  const Layers layers(0.5, 1);
  for (const double length : {0.0, 1e-9, 0.3, 2.5}) {
    std::vector<double> all_kinks;
    for (const double kink : kinks)
      for (const double end : {0.0, length}) all_kinks.push_back(kink + 3.2 + end);
    std::vector<double> shares(20);
    share_kernel(layers, psi, 3.2 + length, 3.2, shares.size(),
                 [&](std::size_t n, double share) { shares[n] += share; });
    for (std::size_t n = 1; n + 1 < shares.size(); ++n) {
      const double exact = quadrature([&](double y) { return psi.along(y, 3.2 + length, 3.2); },
                                      layers.bottom(n), layers.top(n), all_kinks);
      // The last layer within reach of a Gaussian also gets the remaining 1e-17.
      EXPECT_NEAR(shares[n], exact, 1e-12 * exact + 1e-17) << n << " " << length;
    }
  }
}

TEST(CoarseGraining, ANarrowKernelLeavesEveryLayerItsLength)
{
  const Layers layers(1, 1);
  std::vector<double> shares(5), lengths_in(5);
  share_kernel(layers, Kernel(1e-14), 0.3, 3.6, 5,
               [&](std::size_t n, double share) { shares[n] += share; });
  layers.share_segment(0.3, 3.6, 5, [&](std::size_t n, double share) { lengths_in[n] += share; });
  for (std::size_t n = 0; n < 5; ++n) EXPECT_NEAR(shares[n], lengths_in[n], 1e-13);
}

TEST(CoarseGraining, TheFirstLayerTakesWhatIsBelowItAndTheLastWhatIsAbove)
{
  const Kernel wide(0.5);
  std::vector<double> shares(3);
  share_kernel(Layers(1, 1), wide, 0, 0, 3, [&](std::size_t n, double s) { shares[n] += s; });
  EXPECT_NEAR(shares[0], std::erfc(-std::numbers::sqrt2) / 2, 1e-15);  // it ends two widths above
  share_kernel(Layers(1, 1), wide, 9, 9, 3, [&](std::size_t n, double s) { shares[n] += s; });
  EXPECT_NEAR(shares[2], 1 + std::erfc(2 * std::numbers::sqrt2) / 2, 1e-15);
}

TEST(CoarseGraining, AWidthMustBePositive)
{
  for (const double width : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(Kernel{width}, UsageError);
}

}  // namespace
}  // namespace grseg
