// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/estimators.hpp"

#include "analysis/statistics/composition_fit.hpp"
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

/// Mean of of(point) over points with positive total stress, with the weights of B.
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

/// All estimators, computed from B, ln s, k and a.
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

}  // namespace

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

std::pair<double, double> bounds_of_b(const std::vector<FitPoint>& points)
{
  return {weighted_mean(points, [](const FitPoint& p) { return -1 / (1 - p.phi_large); }),
          weighted_mean(points, [](const FitPoint& p) { return 1 / p.phi_large; })};
}

double neutral_mean(const std::vector<FitPoint>& points, const PartitionRule& rule)
{
  return weighted_mean(
      points, [&](const FitPoint& p) { return neutral_b(rule, p.size_ratio, p.phi_large); });
}

namespace {

using Sum = WindowSums::Sum;

/// True if the points have different x, which the fit of a power law needs.
bool spread_out(double w, double wX, double wXX)
{
  return wXX * w - wX * wX > 1e-12 * w * w;
}

/// Sets WindowSums::noise and the parts that composition takes, of these points.
void add_noise(WindowSums& windows, const std::vector<FitPoint>& points)
{
  const auto count = windows.sums.rows();
  windows.noise = Eigen::MatrixXd::Zero(count, Sum::number_of_sums);
  // Calls at(point, weight x noise of `value`) for every point of `own`.
  const auto for_noise = [&](const std::vector<FitPoint>& own, const auto& value,
                             const auto& weight, const auto& at) -> Eigen::MatrixXd {
    if (own.empty()) return {};
    const Eigen::VectorXd weights = numbers_of(own, weight);
    const CompositionFit fit(numbers_of(own, &FitPoint::phi_large), weights);
    const Eigen::VectorXd noise = weights.cwiseProduct(fit.noise(numbers_of(own, value)));
    for (std::size_t k = 0; k < own.size(); ++k)
      at(own[k], windows.noise.row(index(own[k].window)), noise[index(k)]);
    return fit.taken(listed(own, &FitPoint::window), static_cast<std::size_t>(count));
  };
  std::vector<FitPoint> with_logarithm, with_stress;
  for (const auto& point : points) {
    if (point.has_logarithm()) with_logarithm.push_back(point);
    if (point.total > 0) with_stress.push_back(point);
  }
  windows.taken_of_logarithms = for_noise(
      with_logarithm,
      [](const FitPoint& point) { return std::log(point.small / point.large / point.ratio()); },
      &FitPoint::weight,
      [](const FitPoint& point, auto row, double part) {
        row[Sum::wY] += part;
        row[Sum::wXY] += part * std::log(point.ratio());
      });
  windows.taken = for_noise(
      with_stress, [](const FitPoint& point) { return point.excess() / point.product(); },
      [](const FitPoint& point) { return point.frames * point.product(); },
      [](const FitPoint&, auto row, double part) { row[Sum::fD] += part; });
}

}  // namespace

WindowSums window_sums(const std::vector<FitPoint>& points, const RunLengths& runs)
{
  WindowSums windows;
  windows.sums = Eigen::MatrixXd::Zero(index(number_of_windows(runs)), Sum::number_of_sums);
  for (const auto& point : points) {
    auto row = windows.sums.row(index(point.window));
    if (point.total > 0) {
      row[Sum::fD] += point.frames * point.excess();
      row[Sum::fQ] += point.frames * point.product();
    }
    if (!point.has_logarithm()) continue;
    const double w = point.weight, ln_x = std::log(point.ratio()),
                 ln_y = std::log(point.small / point.large);
    row[Sum::w] += w;
    row[Sum::wX] += w * ln_x;
    row[Sum::wY] += w * ln_y;
    row[Sum::wXX] += w * ln_x * ln_x;
    row[Sum::wXY] += w * ln_x * ln_y;
  }
  add_noise(windows, points);
  return windows;
}

Estimators estimators_from_sums(const Eigen::RowVectorXd& total)
{
  const double w = total[Sum::w], w_x = total[Sum::wX], w_y = total[Sum::wY];
  double k = no_number, a = no_number;
  if (spread_out(w, w_x, total[Sum::wXX])) {
    a = (w * total[Sum::wXY] - w_x * w_y) / (w * total[Sum::wXX] - w_x * w_x);
    k = std::exp((w_y - a * w_x) / w);
  }
  return estimators_from(total[Sum::fD] / total[Sum::fQ], (w_y - w_x) / w, k, a);
}

Eigen::Index column_of(double Estimators::*place)
{
  return std::ranges::find(estimator_columns, place, &EstimatorColumn::value) -
         estimator_columns.begin();
}

namespace {

Eigen::RowVectorXd values_of(const Estimators& estimators)
{
  return numbers_of(estimator_columns,
                    [&](const EstimatorColumn& column) { return estimators.*column.value; });
}

}  // namespace

// Derivatives by central differences.
Influence influence_on(double Estimators::*place, const WindowSums& windows)
{
  constexpr double relative_step = 1e-5;
  const Eigen::MatrixXd& sums = windows.sums;
  const Eigen::RowVectorXd total = sums.colwise().sum(), scale = sums.cwiseAbs().colwise().sum();
  Eigen::MatrixXd slope(sums.cols(), index(estimator_columns.size()));
  for (Eigen::Index k = 0; k < sums.cols(); ++k) {
    const double step = scale[k] > 0 ? relative_step * scale[k] : relative_step;
    auto up = total, down = total;
    up[k] += step;
    down[k] -= step;
    slope.row(k) =
        (values_of(estimators_from_sums(up)) - values_of(estimators_from_sums(down))) / (2 * step);
  }
  const Eigen::MatrixXd of_sums = sums * slope, of_noise = windows.noise * slope;
  return {of_sums.col(column_of(place)), of_noise.col(column_of(place))};
}

Errors::Errors(const FitData& data, const WindowSums& windows, double Estimators::*place)
    : Errors(data, place == &Estimators::B ? windows.weight() : windows.weight_of_logarithms(),
             place == &Estimators::B ? windows.taken : windows.taken_of_logarithms)
{
}

Errors::Errors(const FitData& data, const Eigen::VectorXd& weight, const Eigen::MatrixXd& taken)
    : runs_(data.runs), weight_(weight), taken_(taken)
{
  std::map<std::size_t, std::vector<Run>> flows;
  Eigen::Index first = 0;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    flows[data.flow_of(run)].push_back({first, index(data.runs[run])});
    first += index(data.runs[run]);
  }
  for (const auto& [flow, runs] : flows) flows_.push_back({runs, of_runs(runs, weight)});
}

/// Sums over the windows of each run.
Eigen::VectorXd Errors::of_runs(const std::vector<Run>& runs, const Eigen::VectorXd& of_windows)
{
  return numbers_of(
      runs, [&](const Run& run) { return of_windows.segment(run.first, run.windows).sum(); });
}

StandardError Errors::of_flow(const Flow& flow, const Influence& influence) const
{
  if (flow.runs.size() > 1)
    return deviation_of_runs(of_runs(flow.runs, influence.sums), flow.weight).error();
  const auto [first, windows] = flow.runs[0];
  return deviation_of_windows(influence.noise.segment(first, windows),
                              weight_.segment(first, windows), {static_cast<std::size_t>(windows)},
                              taken_.rows() == 0 ? taken_ : taken_.middleRows(first, windows))
      .error();
}

StandardError Errors::over(Population population, const Influence& influence) const
{
  if (population == Population::windows)
    return deviation_of_windows(influence.noise, weight_, runs_, taken_).error();
  return added(listed(flows_, [&](const Flow& flow) { return of_flow(flow, influence); }));
}

std::size_t Errors::single_runs() const
{
  return static_cast<std::size_t>(
      std::ranges::count(flows_, 1U, [](const Flow& flow) { return flow.runs.size(); }));
}

}  // namespace grseg
