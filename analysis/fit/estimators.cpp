// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/estimators.hpp"

#include "analysis/stress/neutral_contacts.hpp"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics.h>

#include <cmath>

namespace grseg {
namespace {

double at_half(double slope)
{
  return 2 * (1 - slope) / (1 + slope);
}

double direct_b(const std::vector<FitPoint>& points)
{
  std::vector<double> product_of, excess_of, weight;
  for (const auto& point : points) {
    if (!(point.total > 0)) continue;
    product_of.push_back(point.product());
    excess_of.push_back(point.excess());
    weight.push_back(point.weight);
  }
  if (weight.empty()) return Estimators::nan;
  double b = 0, variance = 0, chi = 0;
  gsl_fit_wmul(product_of.data(), 1, weight.data(), 1, excess_of.data(), 1, weight.size(), &b,
               &variance, &chi);
  return b;
}

double b_of_sums(const std::vector<FitPoint>& points)
{
  double excess = 0, product = 0;
  for (const auto& point : points) {
    if (!(point.total > 0)) continue;
    excess += point.frames * point.excess();
    product += point.frames * point.product();
  }
  return excess / product;
}

}  // namespace

Estimators estimators_from_slopes(double log_slope, double slope_linear, double prefactor,
                                  double exponent, double direct, double sums)
{
  const double s = std::exp(log_slope);
  Estimators all;
  all.slope = s;
  all.B_half = at_half(s);
  all.B_mean = -log_slope;
  all.B_pure_large = 1 - s;
  all.B_pure_small = (1 - s) / s;
  all.B_paper = (all.B_pure_large + all.B_pure_small) / 2;
  all.slope_linear = slope_linear;
  all.B_linear = at_half(slope_linear);
  all.prefactor_power = prefactor;
  all.exponent = exponent;
  all.B_power = at_half(prefactor);
  all.B_direct = direct;
  all.B_sums = sums;
  return all;
}

Estimators estimators_of(const std::vector<FitPoint>& points)
{
  std::vector<double> x, y, ln_x, ln_y, ln_s, weight;
  for (const auto& point : points) {
    if (!point.has_logarithm()) continue;
    x.push_back(point.ratio());
    y.push_back(point.small / point.large);
    ln_x.push_back(std::log(x.back()));
    ln_y.push_back(std::log(y.back()));
    ln_s.push_back(ln_y.back() - ln_x.back());
    weight.push_back(point.weight);
  }
  const double direct = direct_b(points), sums = b_of_sums(points);
  const std::size_t n = x.size();
  if (n == 0)
    return estimators_from_slopes(Estimators::nan, Estimators::nan, Estimators::nan,
                                  Estimators::nan, direct, sums);

  double linear = 0, intercept = Estimators::nan, exponent = Estimators::nan;
  double c00 = 0, c01 = 0, c11 = 0, chi = 0;
  gsl_fit_mul(x.data(), 1, y.data(), 1, n, &linear, &c11, &chi);
  if (gsl_stats_variance_m(ln_x.data(), 1, n, ln_x[0]) > 1e-12)
    gsl_fit_wlinear(ln_x.data(), 1, weight.data(), 1, ln_y.data(), 1, n, &intercept, &exponent,
                    &c00, &c01, &c11, &chi);
  return estimators_from_slopes(gsl_stats_wmean(weight.data(), 1, ln_s.data(), 1, n), linear,
                                std::exp(intercept), exponent, direct, sums);
}

double neutral_mean(const std::vector<FitPoint>& points, const PartitionRule& rule)
{
  double sum = 0, weights = 0;
  for (const auto& point : points) {
    if (!(point.total > 0)) continue;
    const double w = point.weight * point.product() * point.product();
    sum += w * neutral_b(rule, point.size_ratio, point.phi_large);
    weights += w;
  }
  return sum / weights;
}

}  // namespace grseg
