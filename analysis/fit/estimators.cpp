// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/estimators.hpp"

#include "analysis/frames/sums.hpp"
#include "analysis/statistics/confidence.hpp"
#include "analysis/statistics/least_squares.hpp"
#include "analysis/stress/partition_rule.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

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
  if (n == 0) return estimators_from(b, no_number, no_number, no_number);

  double ln_k = no_number, a = no_number, c00 = 0, c01 = 0, c11 = 0, chi = 0;
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

namespace {

/// The additive sums of a window: w = weight, f = frames, X = ln x, Y = ln y, D = psi_L - phi_L and
/// Q = phi_L phi_S.
enum Sum : Eigen::Index { sum_fD, sum_fQ, sum_w, sum_wX, sum_wY, sum_wXX, sum_wXY, number_of_sums };

/// A power law wants points at different x.
bool spread_out(double w, double wX, double wXX)
{
  return wXX * w - wX * wX > 1e-12 * w * w;
}

/// One statistic as a weighted mean over points: of ln(y/x), or of (psi_L - phi_L)/(phi_L phi_S) with
/// weight f phi_L phi_S.
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
  WeightedMean logarithm, b;
  for (const auto& point : points) {
    if (point.has_logarithm())
      logarithm.add(point, std::log(point.small / point.large / point.ratio()), point.weight);
    if (point.total > 0)
      b.add(point, point.excess() / point.product(), point.frames * point.product());
  }
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(windows, number_of_sums);
  logarithm.for_noise([&](const FitPoint& point, double part) {
    noise(window_of(point), sum_wY) += part;
    noise(window_of(point), sum_wXY) += part * std::log(point.ratio());
  });
  b.for_noise([&](const FitPoint& point, double part) { noise(window_of(point), sum_fD) += part; });
  return noise;
}

}  // namespace

WindowSums window_sums(const std::vector<FitPoint>& points, const RunLengths& runs)
{
  const auto windows = static_cast<Eigen::Index>(number_of_windows(runs));
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(windows, number_of_sums);
  for (const auto& point : points) {
    auto row = sums.row(window_of(point));
    if (point.total > 0) {
      row[sum_fD] += point.frames * point.excess();
      row[sum_fQ] += point.frames * point.product();
    }
    if (!point.has_logarithm()) continue;
    const double w = point.weight, ln_x = std::log(point.ratio()),
                 ln_y = std::log(point.small / point.large);
    row[sum_w] += w;
    row[sum_wX] += w * ln_x;
    row[sum_wY] += w * ln_y;
    row[sum_wXX] += w * ln_x * ln_x;
    row[sum_wXY] += w * ln_x * ln_y;
  }
  return {std::move(sums), window_noise(points, windows)};
}

Eigen::VectorXd WindowSums::weight() const
{
  return sums.col(sum_fQ);
}

Eigen::VectorXd WindowSums::weight_of_logarithms() const
{
  return sums.col(sum_w);
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
  double k = no_number, a = no_number;
  if (spread_out(w, w_x, total[sum_wXX])) {
    a = (w * total[sum_wXY] - w_x * w_y) / (w * total[sum_wXX] - w_x * w_x);
    k = std::exp((w_y - a * w_x) / w);
  }
  return estimators_from(total[sum_fD] / total[sum_fQ], (w_y - w_x) / w, k, a);
}

Dependence dependence(const WindowSums& windows, const RunLengths& runs, bool adds_up)
{
  return adds_up ? dependence(windows.noise.col(sum_fD), windows.sums.col(sum_fQ), runs)
                 : dependence(windows.noise.col(sum_wY), windows.sums.col(sum_w), runs);
}

namespace {

Eigen::VectorXd values_of(const Estimators& estimators)
{
  Eigen::VectorXd values(static_cast<Eigen::Index>(estimator_columns.size()));
  for (std::size_t k = 0; k < estimator_columns.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = estimators.*estimator_columns[k].value;
  return values;
}

/// d(estimators)/d(sums), a row per sum, by central differences.
Eigen::MatrixXd derivatives(const Eigen::MatrixXd& sums)
{
  constexpr double relative_step = 1e-5;
  const Eigen::RowVectorXd total = sums.colwise().sum(), scale = sums.cwiseAbs().colwise().sum();
  Eigen::MatrixXd slope(sums.cols(), static_cast<Eigen::Index>(estimator_columns.size()));
  for (Eigen::Index k = 0; k < sums.cols(); ++k) {
    const double step = scale[k] > 0 ? relative_step * scale[k] : relative_step;
    auto up = total, down = total;
    up[k] += step;
    down[k] -= step;
    slope.row(k) =
        (values_of(estimators_from_sums(up)) - values_of(estimators_from_sums(down))) / (2 * step);
  }
  return slope;
}

}  // namespace

Eigen::Index column_of_estimator(double Estimators::*place)
{
  const auto at = std::find_if(estimator_columns.begin(), estimator_columns.end(),
                               [place](const auto& column) { return column.value == place; });
  return at - estimator_columns.begin();
}

Influences influences_of(const WindowSums& windows)
{
  const Eigen::MatrixXd slope = derivatives(windows.sums);
  return {windows.sums * slope, windows.noise * slope};
}

RunErrors::RunErrors(const FitData& data, const Eigen::VectorXd& weight) : weight_(weight)
{
  std::map<std::size_t, Group> groups;
  std::size_t first = 0;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    auto& group = groups[data.flow_of(run)];
    group.first.push_back(first);
    group.length.push_back(data.runs[run]);
    first += data.runs[run];
  }
  for (auto& [flow, group] : groups) {
    group.weight.resize(static_cast<Eigen::Index>(group.first.size()));
    for (std::size_t k = 0; k < group.first.size(); ++k)
      group.weight[static_cast<Eigen::Index>(k)] =
          weight
              .segment(static_cast<Eigen::Index>(group.first[k]),
                       static_cast<Eigen::Index>(group.length[k]))
              .sum();
    groups_.push_back(std::move(group));
  }
}

StandardError RunErrors::within_flows(const Eigen::VectorXd& sums,
                                      const Eigen::VectorXd& noise) const
{
  std::vector<StandardError> parts;
  for (const auto& group : groups_) {
    const auto run = [&group](const Eigen::VectorXd& of_windows, std::size_t k) {
      return of_windows.segment(static_cast<Eigen::Index>(group.first[k]),
                                static_cast<Eigen::Index>(group.length[k]));
    };
    if (group.first.size() == 1) {
      const Eigen::VectorXd own = run(noise, 0);
      parts.push_back(standard_error(own - own.sum() / group.weight[0] * run(weight_, 0), 1));
      continue;
    }
    Eigen::VectorXd of_runs(group.weight.size());
    for (std::size_t k = 0; k < group.first.size(); ++k)
      of_runs[static_cast<Eigen::Index>(k)] = run(sums, k).sum();
    parts.push_back(scatter_of_runs(of_runs, group.weight));
  }
  return added(parts);
}

double RunErrors::chance_of_likeness(const Eigen::VectorXd& influence, double fitted) const
{
  double sum = 0, all = 0, within = 0, of_means = 0;
  std::size_t runs = 0;
  for (const auto& group : groups_) {
    Eigen::VectorXd value(group.weight.size());
    for (std::size_t k = 0; k < group.first.size(); ++k) {
      const auto place = static_cast<Eigen::Index>(k);
      value[place] = influence
                         .segment(static_cast<Eigen::Index>(group.first[k]),
                                  static_cast<Eigen::Index>(group.length[k]))
                         .sum() /
                     group.weight[place];
    }
    const double weight = group.weight.sum(), mean = group.weight.dot(value) / weight;
    within += group.weight.dot((value.array() - mean).square().matrix());
    of_means += weight * mean * mean;
    sum += weight * mean;
    all += weight;
    runs += group.first.size();
  }
  const auto within_degrees = static_cast<double>(runs - groups_.size());
  if (groups_.size() < 2 || !(within_degrees > 0) || !(within > 0)) return 1;
  const double between_degrees = std::max(1.0, static_cast<double>(groups_.size()) - fitted);
  const double between = of_means - sum * sum / all;
  return gsl_cdf_fdist_Q(between / between_degrees / (within / within_degrees), between_degrees,
                         within_degrees);
}

std::size_t RunErrors::single_runs() const
{
  return static_cast<std::size_t>(std::count_if(
      groups_.begin(), groups_.end(), [](const Group& group) { return group.first.size() == 1; }));
}

}  // namespace grseg
