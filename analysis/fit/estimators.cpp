// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/estimators.hpp"

#include "analysis/statistics/composition_noise.hpp"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics.h>

#include <cmath>
#include <numeric>
#include <utility>

namespace grseg {
namespace {

/// The additive sums of a window: w = weight, X = ln x, Y = ln y, D = psi_L - phi_L and
/// Q = phi_L phi_S.
enum Sum : Eigen::Index {
  sum_w,
  sum_wX,
  sum_wY,
  sum_wXX,
  sum_wXY,
  sum_xx,
  sum_xy,
  sum_wQD,
  sum_wQQ,
  number_of_sums
};

double at_half(double slope)
{
  return 2 * (1 - slope) / (1 + slope);
}

Estimates with_all_b(double log_slope, double slope_linear, double prefactor, double exponent,
                     double direct)
{
  const double s = std::exp(log_slope);
  Estimates all;
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
  return all;
}

double component_of(const Tensor2& stress, Component component)
{
  return component == Component::yy ? stress(1, 1) : stress.trace() / 2;
}

/// psi_L - phi_L, whose slope over phi_L phi_S is B.
double excess(const FitPoint& point)
{
  return point.large / point.total - point.phi_large;
}
double product(const FitPoint& point)
{
  return point.phi_large * (1 - point.phi_large);
}

double direct_b(const std::vector<FitPoint>& points)
{
  std::vector<double> product_of, excess_of, weight;
  for (const auto& point : points) {
    if (!(point.total > 0)) continue;
    product_of.push_back(product(point));
    excess_of.push_back(excess(point));
    weight.push_back(point.weight);
  }
  if (weight.empty()) return Estimates::nan;
  double b = 0, variance = 0, chi = 0;
  gsl_fit_wmul(product_of.data(), 1, weight.data(), 1, excess_of.data(), 1, weight.size(), &b,
               &variance, &chi);
  return b;
}

/// A power law wants points at different x.
bool spread_out(double w, double wX, double wXX)
{
  return wXX * w - wX * wX > 1e-12 * w * w;
}

/// One statistic as a weighted mean over points: of ln(y/x), of y/x with weight x^2 (the line
/// through the origin) or of (psi_L - phi_L)/(phi_L phi_S) with weight w (phi_L phi_S)^2.
struct WeightedMean {
  std::vector<const FitPoint*> points;
  std::vector<double> phi_large, value, weight;

  void add(const FitPoint& point, double of_value, double with_weight)
  {
    points.push_back(&point);
    phi_large.push_back(point.phi_large);
    value.push_back(of_value);
    weight.push_back(with_weight);
  }
  /// Calls at(point, weight x noise) for every point.
  template <class At>
  void for_noise(const At& at) const
  {
    if (points.empty()) return;
    const auto vector = [](const std::vector<double>& list) {
      return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
    };
    const Eigen::VectorXd noise =
        composition_noise(vector(phi_large), vector(value), vector(weight));
    for (std::size_t k = 0; k < points.size(); ++k)
      at(*points[k], weight[k] * noise[static_cast<Eigen::Index>(k)]);
  }
};

Eigen::Index window_of(const FitPoint& point)
{
  return static_cast<Eigen::Index>(point.window);
}

Eigen::MatrixXd window_noise(const std::vector<FitPoint>& points, Eigen::Index windows)
{
  WeightedMean logarithm, linear, direct;
  for (const auto& point : points) {
    if (point.has_logarithm()) {
      const double x = point.ratio(), slope = point.small / point.large / x;
      logarithm.add(point, std::log(slope), point.weight);
      linear.add(point, slope, x * x);
    }
    const double q = product(point);
    if (point.total > 0) direct.add(point, excess(point) / q, point.weight * q * q);
  }
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(windows, number_of_sums);
  logarithm.for_noise([&](const FitPoint& point, double part) {
    noise(window_of(point), sum_wY) += part;
    noise(window_of(point), sum_wXY) += part * std::log(point.ratio());
  });
  linear.for_noise(
      [&](const FitPoint& point, double part) { noise(window_of(point), sum_xy) += part; });
  direct.for_noise(
      [&](const FitPoint& point, double part) { noise(window_of(point), sum_wQD) += part; });
  return noise;
}

}  // namespace

std::vector<FitPoint> fit_points(const FitData& data, const PartitionRule& rule,
                                 const FitSettings& settings)
{
  std::vector<FitPoint> points;
  points.reserve(data.samples.size());
  for (const auto& sample : data.samples) {
    const auto stress = partial_stress(sample.sums, rule, settings.base);
    points.push_back({.window = sample.window,
                      .phi_large = sample.phi_large,
                      .weight = sample.weight,
                      .size_ratio = sample.size_ratio,
                      .small = component_of(stress.small, settings.component),
                      .large = component_of(stress.large, settings.component),
                      .total = component_of(stress.total, settings.component)});
  }
  return points;
}

Estimates estimate(const std::vector<FitPoint>& points)
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
  const double direct = direct_b(points);
  const std::size_t n = x.size();
  if (n == 0)
    return with_all_b(Estimates::nan, Estimates::nan, Estimates::nan, Estimates::nan, direct);

  double linear = 0, intercept = Estimates::nan, exponent = Estimates::nan;
  double c00 = 0, c01 = 0, c11 = 0, chi = 0;
  gsl_fit_mul(x.data(), 1, y.data(), 1, n, &linear, &c11, &chi);
  if (gsl_stats_variance_m(ln_x.data(), 1, n, ln_x[0]) > 1e-12)
    gsl_fit_wlinear(ln_x.data(), 1, weight.data(), 1, ln_y.data(), 1, n, &intercept, &exponent,
                    &c00, &c01, &c11, &chi);
  return with_all_b(gsl_stats_wmean(weight.data(), 1, ln_s.data(), 1, n), linear,
                    std::exp(intercept), exponent, direct);
}

WindowSums window_sums(const std::vector<FitPoint>& points, const RunLengths& runs)
{
  const auto windows =
      static_cast<Eigen::Index>(std::accumulate(runs.begin(), runs.end(), std::size_t{0}));
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(windows, number_of_sums);
  for (const auto& point : points) {
    auto row = sums.row(window_of(point));
    const double w = point.weight;
    if (point.has_logarithm()) {
      const double x = point.ratio(), y = point.small / point.large;
      const double ln_x = std::log(x), ln_y = std::log(y);
      row[sum_w] += w;
      row[sum_wX] += w * ln_x;
      row[sum_wY] += w * ln_y;
      row[sum_wXX] += w * ln_x * ln_x;
      row[sum_wXY] += w * ln_x * ln_y;
      row[sum_xx] += x * x;
      row[sum_xy] += x * y;
    }
    if (point.total > 0) {
      row[sum_wQD] += w * product(point) * excess(point);
      row[sum_wQQ] += w * product(point) * product(point);
    }
  }
  return {std::move(sums), window_noise(points, windows)};
}

Eigen::MatrixXd WindowSums::totals(const Eigen::MatrixXd& times) const
{
  const Eigen::RowVectorXd without_noise = total() - noise.colwise().sum();
  return (times * noise).rowwise() + without_noise;
}

Estimates estimate_from_sums(const Eigen::RowVectorXd& total)
{
  const double w = total[sum_w], w_x = total[sum_wX], w_y = total[sum_wY];
  double prefactor = Estimates::nan, exponent = Estimates::nan;
  if (spread_out(w, w_x, total[sum_wXX])) {
    exponent = (w * total[sum_wXY] - w_x * w_y) / (w * total[sum_wXX] - w_x * w_x);
    prefactor = std::exp((w_y - exponent * w_x) / w);
  }
  return with_all_b((w_y - w_x) / w, total[sum_xy] / total[sum_xx], prefactor, exponent,
                    total[sum_wQD] / total[sum_wQQ]);
}

double neutral_mean(const std::vector<FitPoint>& points, const PartitionRule& rule)
{
  double sum = 0, weights = 0;
  for (const auto& point : points) {
    if (!(point.total > 0)) continue;
    const double w = point.weight * product(point) * product(point);
    sum += w * neutral_b(rule, point.size_ratio, point.phi_large);
    weights += w;
  }
  return sum / weights;
}

Dependence dependence(const WindowSums& windows, const RunLengths& runs, bool adds_up)
{
  const auto of_log = dependence(windows.noise.col(sum_wY), windows.sums.col(sum_w), runs);
  if (!adds_up) return of_log;
  const auto of_direct = dependence(windows.noise.col(sum_wQD), windows.sums.col(sum_wQQ), runs);
  return windows.sums.col(sum_w).any() ? worse(of_log, of_direct) : of_direct;
}

}  // namespace grseg
