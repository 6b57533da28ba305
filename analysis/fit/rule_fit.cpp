// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/rule_fit.hpp"

#include "analysis/fit/window_sums.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grseg {
namespace {

/// Removes what has no meaning where the partial stresses do not add up.
void remove_b(RuleFit& fit)
{
  for (auto* all : {&fit.value, &fit.low, &fit.high})
    for (const auto& [name, place] : estimator_columns)
      if (name[0] == 'B') all->*place = Estimators::nan;
  fit.B_half_windows = {Estimators::nan, Estimators::nan};
}

/// Weighted mean of what a rule gives to the large grains, over that of all mixed stress.
double share_of_large(const FitData& data, const std::vector<FitPoint>& points,
                      const FitSettings& settings)
{
  const auto none = fit_points(data, {PartitionRule::Kind::uniform, 0}, settings);
  const auto all = fit_points(data, {PartitionRule::Kind::uniform, 1}, settings);
  double given = 0, mixed = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    given += points[k].weight * (points[k].large - none[k].large);
    mixed += points[k].weight * (all[k].large - none[k].large);
  }
  return given / mixed;
}

std::vector<Estimators> replicate(const Eigen::MatrixXd& times, const WindowSums& windows)
{
  const Eigen::MatrixXd totals = windows.totals(times);
  std::vector<Estimators> replicates;
  replicates.reserve(static_cast<std::size_t>(totals.rows()));
  for (Eigen::Index sample = 0; sample < totals.rows(); ++sample)
    replicates.push_back(estimators_from_sums(totals.row(sample)));
  return replicates;
}

Eigen::VectorXd column_of(const std::vector<Estimators>& replicates, double Estimators::*place)
{
  Eigen::VectorXd values(static_cast<Eigen::Index>(replicates.size()));
  for (std::size_t k = 0; k < replicates.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = replicates[k].*place;
  return values;
}

void add_intervals(RuleFit& fit, const WindowSums& windows, const Bootstrap& bootstrap)
{
  const auto replicates = replicate(bootstrap.samples(fit.dependence), windows);
  for (const auto& [name, place] : estimator_columns) {
    const auto interval =
        bootstrap.interval(fit.value.*place, column_of(replicates, place), fit.dependence);
    fit.low.*place = interval.low;
    fit.high.*place = interval.high;
  }
  const auto inside = replicate(bootstrap.blocks(fit.dependence.block), windows);
  fit.B_half_windows = bootstrap.over_windows(
      fit.value.B_half, column_of(inside, &Estimators::B_half), fit.dependence);
}

void add_minus_size(RuleFit& fit, const WindowSums& windows,
                    const std::vector<FitPoint>& size_points, const Bootstrap& bootstrap)
{
  fit.minus_size = fit.value.B_direct - estimators_of(size_points).B_direct;
  if (bootstrap.count() == 0) return;
  const auto by_size = window_sums(size_points, bootstrap.runs());
  const auto& times = bootstrap.samples(fit.dependence);
  fit.minus_size_interval =
      bootstrap.interval(fit.minus_size,
                         column_of(replicate(times, windows), &Estimators::B_direct) -
                             column_of(replicate(times, by_size), &Estimators::B_direct),
                         fit.dependence);
}

}  // namespace

void add_components(RuleFit& fit, const FitData& data, const FitSettings& settings,
                    const Bootstrap& bootstrap)
{
  const auto is_yy = settings.component == Component::yy;
  auto &own = is_yy ? fit.B_yy : fit.B_pressure, &other = is_yy ? fit.B_pressure : fit.B_yy;
  const auto b_half_of = [](const RuleFit& of) {
    return Estimate{of.value.B_half, of.low.B_half, of.high.B_half};
  };
  own = b_half_of(fit);
  const FitSettings swapped{is_yy ? Component::pressure : Component::yy, settings.base};
  if (fit.rule.adds_up() && has_stresses(data, fit.rule, swapped))
    other = b_half_of(fit_rule(data, fit.rule, swapped, bootstrap));
}

Dependence dependence(const FitData& data, const PartitionRule& rule, const FitSettings& settings)
{
  return dependence(window_sums(fit_points(data, rule, settings), data.runs), data.runs,
                    rule.adds_up());
}

RuleFit fit_rule(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                 const Bootstrap& bootstrap, const std::optional<Dependence>& common)
{
  const auto points = fit_points(data, rule, settings);
  const auto windows = window_sums(points, data.runs);
  RuleFit fit;
  fit.rule = rule;
  fit.pair = data.samples.front().pair;
  fit.points = static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [](const auto& p) { return p.has_logarithm(); }));
  fit.not_positive = points.size() - fit.points;
  fit.value = estimators_of(points);
  fit.dependence = common ? *common : dependence(windows, data.runs, rule.adds_up());
  fit.doubt = fit.points > 0 ? bootstrap.doubt(fit.dependence)
                             : fmt::format(
                                   "in none of {} layers and windows do both species bear a "
                                   "positive stress, so that their ratio has no value",
                                   points.size());
  if (bootstrap.count() > 0) add_intervals(fit, windows, bootstrap);
  if (!rule.adds_up()) {
    remove_b(fit);
  } else if (data.quantity == Quantity::contact) {
    if (data.species.size() <= 2) {
      fit.share = share_of_large(data, points, settings);
      fit.neutral = neutral_mean(points, rule);
    }
    add_minus_size(fit, windows, fit_points(data, PartitionRule{}, settings), bootstrap);
  }
  return fit;
}

}  // namespace grseg
