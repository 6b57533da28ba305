// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/window_sums.hpp"

#include "analysis/statistics/composition_noise.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace grseg {
namespace {

/// The additive sums of a window: w = weight, f = frames, X = ln x, Y = ln y, D = psi_L - phi_L and
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
  sum_fD,
  sum_fQ,
  number_of_sums
};

/// A power law wants points at different x.
bool spread_out(double w, double wX, double wXX)
{
  return wXX * w - wX * wX > 1e-12 * w * w;
}

/// One statistic as a weighted mean over points: of ln(y/x), of y/x with weight x^2 (the line
/// through the origin) or of (psi_L - phi_L)/(phi_L phi_S) with weight w (phi_L phi_S)^2 or, of the
/// sums, f phi_L phi_S.
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
  WeightedMean logarithm, linear, direct, of_sums;
  for (const auto& point : points) {
    if (point.has_logarithm()) {
      const double x = point.ratio(), slope = point.small / point.large / x;
      logarithm.add(point, std::log(slope), point.weight);
      linear.add(point, slope, x * x);
    }
    const double q = point.product();
    if (!(point.total > 0)) continue;
    direct.add(point, point.excess() / q, point.weight * q * q);
    of_sums.add(point, point.excess() / q, point.frames * q);
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
  of_sums.for_noise(
      [&](const FitPoint& point, double part) { noise(window_of(point), sum_fD) += part; });
  return noise;
}

}  // namespace

WindowSums window_sums(const std::vector<FitPoint>& points, const RunLengths& runs)
{
  const auto windows = static_cast<Eigen::Index>(number_of_windows(runs));
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
      row[sum_wQD] += w * point.product() * point.excess();
      row[sum_wQQ] += w * point.product() * point.product();
      row[sum_fD] += point.frames * point.excess();
      row[sum_fQ] += point.frames * point.product();
    }
  }
  return {std::move(sums), window_noise(points, windows)};
}

Eigen::VectorXd WindowSums::weight() const
{
  return sums.col(sums.col(sum_w).any() ? sum_w : sum_wQQ);
}

Eigen::VectorXd WindowSums::excess() const
{
  return sums.col(sum_fD);
}

Eigen::VectorXd WindowSums::excess_noise() const
{
  return noise.col(sum_fD);
}

Eigen::MatrixXd WindowSums::totals(const Eigen::MatrixXd& times) const
{
  const Eigen::RowVectorXd without_noise = total() - noise.colwise().sum();
  return (times * noise).rowwise() + without_noise;
}

Estimators estimators_from_sums(const Eigen::RowVectorXd& total)
{
  const double w = total[sum_w], w_x = total[sum_wX], w_y = total[sum_wY];
  double prefactor = Estimators::nan, exponent = Estimators::nan;
  if (spread_out(w, w_x, total[sum_wXX])) {
    exponent = (w * total[sum_wXY] - w_x * w_y) / (w * total[sum_wXX] - w_x * w_x);
    prefactor = std::exp((w_y - exponent * w_x) / w);
  }
  return estimators_from_slopes((w_y - w_x) / w, total[sum_xy] / total[sum_xx], prefactor, exponent,
                                total[sum_wQD] / total[sum_wQQ], total[sum_fD] / total[sum_fQ]);
}

Dependence dependence(const WindowSums& windows, const RunLengths& runs, bool adds_up)
{
  const auto of_log = dependence(windows.noise.col(sum_wY), windows.sums.col(sum_w), runs);
  if (!adds_up) return of_log;
  const auto of_psi = worse(dependence(windows.noise.col(sum_wQD), windows.sums.col(sum_wQQ), runs),
                            dependence(windows.noise.col(sum_fD), windows.sums.col(sum_fQ), runs));
  return windows.sums.col(sum_w).any() ? worse(of_log, of_psi) : of_psi;
}

}  // namespace grseg
