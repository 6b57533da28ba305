// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/rule_fit.hpp"

#include "analysis/fit/run_errors.hpp"
#include "analysis/fit/window_sums.hpp"
#include "analysis/statistics/composition_noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// Removes what has no meaning where the partial stresses do not add up.
void remove_b(RuleFit& fit)
{
  for (auto* all : {&fit.value, &fit.low, &fit.high, &fit.error})
    for (const auto& [name, place] : estimator_columns)
      if (name[0] == 'B') all->*place = Estimators::nan;
  fit.B_half_windows = fit.B_sums_windows = {Estimators::nan, Estimators::nan};
  fit.B_over.fill({});
  fit.B_sums_over.fill({});
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

StandardError window_error(const std::vector<Estimators>& of_blocks, double Estimators::*place,
                           const RuleFit& fit, const Bootstrap& bootstrap)
{
  return bootstrap.window_error(column_of(of_blocks, place), fit.dependence);
}

/// Errors over windows, over runs within mixtures and over runs about one function of composition;
/// those that the fit is over become its intervals.
void add_intervals(RuleFit& fit, const FitData& data, const WindowSums& windows,
                   const Bootstrap& bootstrap)
{
  const auto of_blocks = replicate(bootstrap.blocks(fit.dependence.block), windows);
  const auto of_runs = replicate(bootstrap.whole_runs(), windows);
  const auto influences = influences_of(windows);
  const RunErrors run_errors(data, windows.weight());
  for (const auto& [name, place] : estimator_columns) {
    const auto column = column_of_estimator(place);
    const auto over_windows = window_error(of_blocks, place, fit, bootstrap);
    const auto about_one_function = bootstrap.run_error(column_of(of_runs, place), fit.dependence);
    const auto within =
        run_errors.within_mixtures(influences.sums.col(column), influences.noise.col(column));
    set_error(fit, place,
              fit.over == Over::windows        ? over_windows
              : fit.over == Over::compositions ? about_one_function
                                               : within);
    if (place != &Estimators::B_half && place != &Estimators::B_sums) continue;
    auto& over = place == &Estimators::B_half ? fit.B_over : fit.B_sums_over;
    const double value = fit.value.*place;
    const auto set = [&](Over population, const StandardError& error) {
      over[static_cast<std::size_t>(population)] = error.around(value);
    };
    set(Over::windows, over_windows);
    if (fit.runs < 2) continue;
    set(Over::compositions, about_one_function);
    set(data.number_of_mixtures() > 1 ? Over::mixtures : Over::runs, within);
  }
  fit.B_half_windows = {fit.at(Over::windows).low, fit.at(Over::windows).high};
  fit.B_sums_windows = {fit.sums_at(Over::windows).low, fit.sums_at(Over::windows).high};
}

StandardError error_of_minus_size(const RuleFit& fit, const FitData& data,
                                  const WindowSums& windows, const WindowSums& by_size,
                                  const Bootstrap& bootstrap)
{
  if (fit.over == Over::windows || fit.over == Over::compositions) {
    const auto& times =
        fit.over == Over::windows ? bootstrap.blocks(fit.dependence.block) : bootstrap.whole_runs();
    const Eigen::VectorXd samples = column_of(replicate(times, windows), &Estimators::B_direct) -
                                    column_of(replicate(times, by_size), &Estimators::B_direct);
    return fit.over == Over::windows ? bootstrap.window_error(samples, fit.dependence)
                                     : bootstrap.run_error(samples, fit.dependence);
  }
  const auto direct = column_of_estimator(&Estimators::B_direct);
  const auto own = influences_of(windows), others = influences_of(by_size);
  return RunErrors(data, windows.weight())
      .within_mixtures(own.sums.col(direct) - others.sums.col(direct),
                       own.noise.col(direct) - others.noise.col(direct));
}

Measured minus_size(const RuleFit& fit, const FitData& data, const WindowSums& windows,
                    const std::vector<FitPoint>& size_points, const Bootstrap& bootstrap)
{
  const double difference = fit.value.B_direct - estimators_of(size_points).B_direct;
  if (bootstrap.count() == 0) return {difference};
  return {difference, error_of_minus_size(fit, data, windows,
                                          window_sums(size_points, bootstrap.runs()), bootstrap)};
}

/// Of the differences between mixtures, how many degrees of freedom the noise lacks.
double degrees_taken_by_composition(const FitData& data)
{
  const auto size = static_cast<Eigen::Index>(data.samples.size());
  const auto mixture_of_window = data.mixtures_of_windows();
  Eigen::VectorXd phi_large(size), weight(size);
  std::vector<std::size_t> mixture;
  mixture.reserve(data.samples.size());
  for (const auto& sample : data.samples) {
    const auto place = static_cast<Eigen::Index>(mixture.size());
    phi_large[place] = sample.phi_large;
    weight[place] = sample.weight;
    mixture.push_back(mixture_of_window[sample.window]);
  }
  return degrees_of_composition(phi_large, weight, mixture);
}

/// What limits the interval, mostly nothing.
std::string doubt_of(const RuleFit& fit, const FitData& data, const WindowSums& windows,
                     const Bootstrap& bootstrap)
{
  if (bootstrap.count() == 0) return {};
  if (fit.over == Over::windows) return bootstrap.doubt_of_windows(fit.dependence);
  const auto mixtures = data.number_of_mixtures();
  if (mixtures == 1) return bootstrap.doubt_of_runs(fit.dependence);
  const RunErrors errors(data, windows.weight());
  if (fit.over == Over::compositions) {
    const auto column = column_of_estimator(&Estimators::B_half);
    const double chance = errors.chance_of_likeness(influences_of(windows).noise.col(column),
                                                    degrees_taken_by_composition(data));
    if (chance >= 0.05) return bootstrap.doubt_of_runs(fit.dependence);
    return fmt::format(
        "mixtures differ by more than one function of composition explains (Fisher's test: {:.2g}): "
        "over compositions the interval is too wide for these mixtures and too narrow for others; "
        "see those over mixtures, equal-mixtures and random-mixtures",
        chance);
  }
  return doubt_of_mixtures(fit, errors.single_runs(), mixtures);
}

}  // namespace

void set_error(RuleFit& fit, double Estimators::*place, const StandardError& error)
{
  const auto interval = error.interval_around(fit.value.*place);
  fit.low.*place = interval.low;
  fit.high.*place = interval.high;
  fit.error.*place = error.error;
  if (place == &Estimators::B_half) fit.degrees = error.degrees;
}

// sigma^L is linear in the share p, so that the sum over frames of psi_L - phi_L is zero at
// p* = -D(0)/(D(1) - D(0)); what a window adds to p* is its D(p*) over that slope.
Measured zero_of_sums(const FitData& data, const FitSettings& settings, const Bootstrap& bootstrap,
                      Over over, const Dependence& how_dependent)
{
  if (data.quantity != Quantity::contact || data.species.size() > 2) return {};
  const auto sum_at = [&](double share) {
    double sum = 0;
    for (const auto& point : fit_points(data, {PartitionRule::Kind::uniform, share}, settings))
      if (point.total > 0) sum += point.frames * point.excess();
    return sum;
  };
  const double none = sum_at(0), slope = sum_at(1) - none, zero = -none / slope;
  if (bootstrap.count() == 0 || !std::isfinite(zero)) return {zero};
  const auto windows = window_sums(fit_points(data, {PartitionRule::Kind::uniform, zero}, settings),
                                   bootstrap.runs());
  const Eigen::VectorXd sums = windows.excess() / -slope, noise = windows.excess_noise() / -slope;
  return {zero,
          over == Over::windows
              ? bootstrap.window_error(bootstrap.blocks(how_dependent.block) * noise, how_dependent)
          : over == Over::compositions
              ? bootstrap.run_error(bootstrap.whole_runs() * noise, how_dependent)
              : RunErrors(data, windows.weight()).within_mixtures(sums, noise)};
}

std::string doubt_of_mixtures(const RuleFit& fit, std::size_t single_runs, std::size_t mixtures)
{
  if (single_runs > 0)
    return fmt::format(
        "{} of {} mixtures {} one run: the scatter of its windows stands for that of runs, which "
        "is too narrow where runs differ",
        single_runs, mixtures, single_runs == 1 ? "has" : "have");
  if (!(fit.degrees <= 3.5)) return {};
  return fmt::format(
      "{} runs of {} mixtures leave {:.2g} degrees of freedom; more runs of each "
      "give a narrower interval",
      fit.runs, mixtures, fit.degrees);
}

std::string doubt_of_logarithms(const RuleFit& fit, double window)
{
  const double apart = std::abs(fit.value.B_half - fit.value.B_sums);
  const double reach = (fit.high.B_half - fit.low.B_half + fit.high.B_sums - fit.low.B_sums) / 2;
  if (!(std::abs(fit.neutral) < 1e-3) || !(apart > reach)) return {};
  return fmt::format(
      "B_half = {:.4f} and B_sums = {:.4f} differ by more than their intervals: in windows of {:g} s "
      "the mean of ln(y/x) suffers from few grains, or B differs between layers or mixtures, which "
      "the two weigh differently",
      fit.value.B_half, fit.value.B_sums, window);
}

void add_doubt(RuleFit& fit, const std::string& doubt)
{
  if (!fit.doubt.empty() && !doubt.empty()) fit.doubt += "; ";
  fit.doubt += doubt;
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
  fit.runs = data.runs.size();
  fit.over = resolved(settings.over, fit.runs, data.number_of_mixtures());
  if (bootstrap.count() > 0) add_intervals(fit, data, windows, bootstrap);
  fit.doubt = fit.points > 0 ? doubt_of(fit, data, windows, bootstrap)
                             : fmt::format(
                                   "in none of {} layers and windows do both species bear a "
                                   "positive stress, so that their ratio has no value",
                                   points.size());
  if (!rule.adds_up()) {
    remove_b(fit);
  } else if (data.quantity == Quantity::contact) {
    if (data.species.size() <= 2) {
      fit.share = share_of_large(data, points, settings);
      fit.neutral = neutral_mean(points, rule);
      if (!common)
        fit.p_zero_sums = zero_of_sums(data, settings, bootstrap, fit.over, fit.dependence);
    }
    add_doubt(fit, doubt_of_logarithms(fit, data.window));
    fit.minus_size =
        minus_size(fit, data, windows, fit_points(data, PartitionRule{}, settings), bootstrap);
  }
  return fit;
}

}  // namespace grseg
