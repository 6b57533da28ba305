// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/size_exponent.hpp"

#include "analysis/fit/estimators.hpp"
#include "analysis/fit/rule_fit.hpp"
#include "analysis/fit/run_errors.hpp"
#include "analysis/fit/window_sums.hpp"

#include <cmath>

namespace grseg {
namespace {

/// Points of which B_mean, minus the weighted mean of ln(y/x), is a: the logarithms over ln r, and
/// weights that give the least-squares slope.
std::vector<FitPoint> points_per_size(const std::vector<FitPoint>& points)
{
  std::vector<FitPoint> scaled;
  for (auto point : points) {
    const double size = std::log(point.size_ratio);
    if (!point.has_logarithm() || !(size > 0)) continue;
    const double slope = std::pow(point.small / point.large / point.ratio(), 1 / size);
    point.weight *= size * size;
    point.large = 1;
    point.small = slope * point.ratio();
    point.total = point.small + point.large;
    scaled.push_back(point);
  }
  return scaled;
}

}  // namespace

Estimate size_exponent(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                       const Bootstrap& bootstrap)
{
  const auto points = points_per_size(fit_points(data, rule, settings));
  Estimate a{estimators_of(points).B_mean};
  if (points.empty() || bootstrap.count() == 0) return a;
  const auto windows = window_sums(points, data.runs);
  const auto over = resolved(settings.over, data.runs.size(), data.number_of_mixtures());
  Interval interval{a.low, a.high};
  if (over == Over::runs || over == Over::mixtures) {
    const auto influences = influences_of(windows);
    const auto column = column_of_estimator(&Estimators::B_mean);
    interval = RunErrors(data, windows.weight())
                   .within_mixtures(influences.sums.col(column), influences.noise.col(column))
                   .interval_around(a.value);
  } else if (over == Over::windows || over == Over::compositions) {
    const Dependence how_dependent = dependence(data, rule, settings);
    const auto& times =
        over == Over::windows ? bootstrap.blocks(how_dependent.block) : bootstrap.whole_runs();
    const Eigen::MatrixXd totals = windows.totals(times);
    Eigen::VectorXd samples(totals.rows());
    for (Eigen::Index k = 0; k < samples.size(); ++k)
      samples[k] = estimators_from_sums(totals.row(k)).B_mean;
    interval = over == Over::windows ? bootstrap.over_windows(a.value, samples, how_dependent)
                                     : bootstrap.over_runs(a.value, samples, how_dependent);
  }
  return {a.value, interval.low, interval.high};
}

}  // namespace grseg
