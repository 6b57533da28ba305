// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation_fit.hpp"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics.h>

#include <algorithm>
#include <cmath>

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
  all.B_half_sum = (all.B_pure_large + all.B_pure_small) / 2;
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

/// Removes what has no meaning where the partial stresses do not add up.
void forget_b(Estimates& estimates)
{
  for (const auto& [name, place] : estimator_names)
    if (name[0] == 'B') estimates.*place = Estimates::nan;
}

Eigen::VectorXd column_of(const std::vector<Estimates>& replicates, double Estimates::*place)
{
  Eigen::VectorXd values(static_cast<Eigen::Index>(replicates.size()));
  for (std::size_t k = 0; k < replicates.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = replicates[k].*place;
  return values;
}

std::vector<Estimates> replicate(const Eigen::MatrixXd& times, const Eigen::MatrixXd& sums)
{
  std::vector<Estimates> replicates;
  if (times.rows() == 0) return replicates;
  const Eigen::MatrixXd totals = times * sums;
  replicates.reserve(static_cast<std::size_t>(totals.rows()));
  for (Eigen::Index sample = 0; sample < totals.rows(); ++sample)
    replicates.push_back(estimate_from_sums(totals.row(sample)));
  return replicates;
}

/// How a statistic scatters over the two kinds of samples.
struct Replicates {
  Eigen::VectorXd inside, between;
};

Interval interval_of(double estimate, const Replicates& replicates, const Bootstrap& bootstrap,
                     const Dependence& dependence)
{
  return bootstrap.runs().size() > 1
             ? bootstrap.over_runs(estimate, replicates.between, dependence)
             : bootstrap.over_windows(estimate, replicates.inside, dependence);
}

void add_intervals(RuleFit& fit, const Eigen::MatrixXd& sums, const Bootstrap& bootstrap)
{
  const auto inside = replicate(bootstrap.blocks(fit.dependence.block), sums);
  const auto between = replicate(bootstrap.whole_runs(), sums);
  for (const auto& [name, place] : estimator_names) {
    const auto interval =
        interval_of(fit.value.*place, {column_of(inside, place), column_of(between, place)},
                    bootstrap, fit.dependence);
    fit.low.*place = interval.low;
    fit.high.*place = interval.high;
  }
  fit.B_half_windows = bootstrap.over_windows(
      fit.value.B_half, column_of(inside, &Estimates::B_half), fit.dependence);
}

void add_minus_size(RuleFit& fit, const std::vector<FitPoint>& points,
                    const std::vector<FitPoint>& by_size, const Bootstrap& bootstrap)
{
  fit.minus_size = fit.value.B_direct - direct_b(by_size);
  if (bootstrap.samples() == 0) return;
  const Eigen::MatrixXd sums = window_sums(points, bootstrap.runs());
  const Eigen::MatrixXd size_sums = window_sums(by_size, bootstrap.runs());
  const auto difference = [&](const Eigen::MatrixXd& times) -> Eigen::VectorXd {
    return column_of(replicate(times, sums), &Estimates::B_direct) -
           column_of(replicate(times, size_sums), &Estimates::B_direct);
  };
  fit.minus_size_interval = interval_of(
      fit.minus_size,
      {difference(bootstrap.blocks(fit.dependence.block)), difference(bootstrap.whole_runs())},
      bootstrap, fit.dependence);
}

bool adds_up(const PartitionRule& rule)
{
  return rule.kind != PartitionRule::Kind::drop;
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

Eigen::MatrixXd window_sums(const std::vector<FitPoint>& points, const RunLengths& runs)
{
  Eigen::Index windows = 0;
  for (const auto length : runs) windows += static_cast<Eigen::Index>(length);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(windows, number_of_sums);
  for (const auto& point : points) {
    auto row = sums.row(static_cast<Eigen::Index>(point.window));
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
  return sums;
}

Estimates estimate_from_sums(const Eigen::RowVectorXd& sums)
{
  const double w = sums[sum_w], w_x = sums[sum_wX], w_y = sums[sum_wY];
  double prefactor = Estimates::nan, exponent = Estimates::nan;
  if (spread_out(w, w_x, sums[sum_wXX])) {
    exponent = (w * sums[sum_wXY] - w_x * w_y) / (w * sums[sum_wXX] - w_x * w_x);
    prefactor = std::exp((w_y - exponent * w_x) / w);
  }
  return with_all_b((w_y - w_x) / w, sums[sum_xy] / sums[sum_xx], prefactor, exponent,
                    sums[sum_wQD] / sums[sum_wQQ]);
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

Dependence dependence_of(const FitData& data, const PartitionRule& rule,
                         const FitSettings& settings)
{
  const Eigen::MatrixXd sums = window_sums(fit_points(data, rule, settings), data.runs);
  const Eigen::RowVectorXd total = sums.colwise().sum();
  const Eigen::VectorXd logarithm = sums.col(sum_wY) - sums.col(sum_wX);
  const double mean = (total[sum_wY] - total[sum_wX]) / total[sum_w];
  const auto of_log = dependence(logarithm - mean * sums.col(sum_w), sums.col(sum_w), data.runs);
  if (!adds_up(rule)) return of_log;
  const double b = total[sum_wQD] / total[sum_wQQ];
  const auto of_direct =
      dependence(sums.col(sum_wQD) - b * sums.col(sum_wQQ), sums.col(sum_wQQ), data.runs);
  return total[sum_w] > 0 ? worse(of_log, of_direct) : of_direct;
}

RuleFit fit_rule(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                 const Bootstrap& bootstrap)
{
  return fit_rule(data, rule, settings, bootstrap, dependence_of(data, rule, settings));
}

RuleFit fit_rule(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                 const Bootstrap& bootstrap, const Dependence& dependence)
{
  const auto points = fit_points(data, rule, settings);
  const bool contact = data.quantity == Quantity::contact;
  RuleFit fit;
  fit.rule = rule;
  fit.points = static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [](const auto& p) { return p.has_logarithm(); }));
  fit.not_positive = points.size() - fit.points;
  fit.value = estimate(points);
  if (contact) fit.neutral = neutral_mean(points, rule);
  fit.dependence = dependence;
  fit.doubt = bootstrap.doubt(dependence);

  if (bootstrap.samples() > 0) add_intervals(fit, window_sums(points, data.runs), bootstrap);
  if (!adds_up(rule)) {
    for (auto* all : {&fit.value, &fit.low, &fit.high}) forget_b(*all);
    fit.B_half_windows = {Estimates::nan, Estimates::nan};
  } else if (contact) {
    add_minus_size(fit, points, fit_points(data, PartitionRule{}, settings), bootstrap);
  }
  return fit;
}

}  // namespace grseg
