// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/size_exponent.hpp"

#include "analysis/fit/estimators.hpp"
#include "analysis/fit/flows.hpp"
#include "analysis/fit/rule_fit.hpp"
#include "analysis/fit/run_errors.hpp"
#include "analysis/fit/window_sums.hpp"
#include "analysis/statistics/confidence.hpp"

#include <cmath>
#include <set>
#include <vector>

namespace grseg {
namespace {

/// Points of which minus the weighted mean of ln(y/x) is a: the logarithms over ln r, and
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

StandardError error_of(const WindowSums& windows, const FitData& data, Over over,
                       const Dependence& how_dependent, const Bootstrap& bootstrap)
{
  if (over != Over::windows && over != Over::compositions) {
    const auto influences = influences_of(windows);
    const auto column = column_of_estimator(&Estimators::minus_ln_s);
    return RunErrors(data, windows.weight_of_logarithms())
        .within_flows(influences.sums.col(column), influences.noise.col(column));
  }
  const auto& times =
      over == Over::windows ? bootstrap.blocks(how_dependent.block) : bootstrap.whole_runs();
  const Eigen::MatrixXd totals = windows.totals(times);
  Eigen::VectorXd samples(totals.rows());
  for (Eigen::Index k = 0; k < samples.size(); ++k)
    samples[k] = estimators_from_sums(totals.row(k)).minus_ln_s;
  return over == Over::windows ? bootstrap.window_error(samples, how_dependent)
                               : bootstrap.run_error(samples, how_dependent);
}

/// Of all points together.
Measured pooled_exponent(const FitData& data, const PartitionRule& rule,
                         const FitSettings& settings, const Resampling& resampling)
{
  const auto points = points_per_size(fit_points(data, rule, settings));
  const double a = estimators_of(points).minus_ln_s;
  if (points.empty() || resampling.samples == 0) return {a};
  const auto over = resolved(settings.over, data.runs.size(), data.number_of_flows());
  return {a, error_of(window_sums(points, data.runs), data, over, dependence(data, rule, settings),
                      Bootstrap(data.runs, resampling.samples, resampling.seed))};
}

}  // namespace

Estimate size_exponent(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                       const Resampling& resampling)
{
  const bool equal = settings.over == Over::equal_flows,
             random = settings.over == Over::random_flows;
  if (data.number_of_flows() == 1 || (!equal && !random))
    return pooled_exponent(data, rule, settings, resampling).estimate();
  auto of_one = settings;
  of_one.over = Over::automatic;
  std::vector<Measured> of_each;
  of_each.reserve(data.number_of_flows());
  for (const auto flow : std::set(data.flows.begin(), data.flows.end()))
    of_each.push_back(pooled_exponent(of_flow(data, flow), rule, of_one, resampling));
  const auto mean = mean_of_equals(of_each);
  return (equal ? mean.by_errors : mean.by_scatter).around(mean.value);
}

}  // namespace grseg
