// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/estimators.hpp"

#include "analysis/stress/partition_rule.hpp"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics.h>

#include <cmath>

namespace grseg {
namespace {

/// The mean of `of` over points with the weight of B.
template <class Of>
double weighted_mean(const std::vector<FitPoint>& points, const Of& of)
{
  double sum = 0, weights = 0;
  for (const auto& point : points) {
    if (!(point.total > 0)) continue;
    sum += point.frames * point.product() * of(point);
    weights += point.frames * point.product();
  }
  return sum / weights;
}

}  // namespace

Estimators estimators_from(double b, double ln_s, double k, double a)
{
  const double s = std::exp(ln_s);
  return {.B = b,
          .paper_s = s,
          .paper_B = (1 - s + (1 - s) / s) / 2,
          .paper_k = k,
          .paper_a = a,
          .minus_ln_s = -ln_s};
}

Estimators estimators_of(const std::vector<FitPoint>& points)
{
  const double b =
      weighted_mean(points, [](const FitPoint& p) { return p.excess() / p.product(); });
  std::vector<double> ln_x, ln_y, ln_s, weight;
  for (const auto& point : points) {
    if (!point.has_logarithm()) continue;
    ln_x.push_back(std::log(point.ratio()));
    ln_y.push_back(std::log(point.small / point.large));
    ln_s.push_back(ln_y.back() - ln_x.back());
    weight.push_back(point.weight);
  }
  const std::size_t n = ln_x.size();
  if (n == 0) return estimators_from(b, Estimators::nan, Estimators::nan, Estimators::nan);

  double ln_k = Estimators::nan, a = Estimators::nan, c00 = 0, c01 = 0, c11 = 0, chi = 0;
  if (gsl_stats_variance_m(ln_x.data(), 1, n, ln_x[0]) > 1e-12)
    gsl_fit_wlinear(ln_x.data(), 1, weight.data(), 1, ln_y.data(), 1, n, &ln_k, &a, &c00, &c01,
                    &c11, &chi);
  return estimators_from(b, gsl_stats_wmean(weight.data(), 1, ln_s.data(), 1, n), std::exp(ln_k),
                         a);
}

double neutral_mean(const std::vector<FitPoint>& points, const PartitionRule& rule)
{
  return weighted_mean(
      points, [&](const FitPoint& p) { return neutral_b(rule, p.size_ratio, p.phi_large); });
}

}  // namespace grseg
