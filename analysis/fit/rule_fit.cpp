// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/rule_fit.hpp"

#include "analysis/fit/estimators.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/statistics/least_squares.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// Removes what has no meaning where the partial stresses do not add up.
void remove_b(RuleFit& fit)
{
  for (auto* all : {&fit.value, &fit.low, &fit.high, &fit.error}) all->B = all->paper_B = no_number;
  fit.B_over.fill({});
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

/// Errors over windows, over runs within flows and over runs about one function of composition;
/// those that the fit is over become its intervals.
void add_intervals(RuleFit& fit, const FitData& data, const WindowSums& windows,
                   const Bootstrap& bootstrap)
{
  const auto of_blocks = replicate(bootstrap.blocks(fit.dependence.block), windows);
  const auto of_runs = replicate(bootstrap.whole_runs(), windows);
  const auto influences = influences_of(windows);
  const RunErrors of_b(data, windows.weight()), of_logarithms(data, windows.weight_of_logarithms());
  for (const auto& [name, place] : estimator_columns) {
    const bool is_b = place == &Estimators::B;
    const auto column = column_of_estimator(place);
    const auto over_windows = window_error(of_blocks, place, fit, bootstrap);
    const auto about_one_function = bootstrap.run_error(column_of(of_runs, place), fit.dependence);
    const auto within =
        (is_b ? of_b : of_logarithms)
            .within_flows(influences.sums.col(column), influences.noise.col(column));
    set_error(fit, place,
              fit.over == Population::windows        ? over_windows
              : fit.over == Population::compositions ? about_one_function
                                                     : within);
    if (!is_b) continue;
    fit.at(Population::windows) = over_windows.around(fit.value.B);
    if (fit.runs < 2) continue;
    fit.at(Population::compositions) = about_one_function.around(fit.value.B);
    fit.at(data.number_of_flows() > 1 ? Population::flows : Population::runs) =
        within.around(fit.value.B);
  }
}

StandardError error_of_minus_size(const RuleFit& fit, const FitData& data,
                                  const WindowSums& windows, const WindowSums& by_size,
                                  const Bootstrap& bootstrap)
{
  if (fit.over == Population::windows || fit.over == Population::compositions) {
    const auto& times = fit.over == Population::windows ? bootstrap.blocks(fit.dependence.block)
                                                        : bootstrap.whole_runs();
    const Eigen::VectorXd samples = column_of(replicate(times, windows), &Estimators::B) -
                                    column_of(replicate(times, by_size), &Estimators::B);
    return fit.over == Population::windows ? bootstrap.window_error(samples, fit.dependence)
                                           : bootstrap.run_error(samples, fit.dependence);
  }
  const auto column = column_of_estimator(&Estimators::B);
  const auto own = influences_of(windows), others = influences_of(by_size);
  return RunErrors(data, windows.weight())
      .within_flows(own.sums.col(column) - others.sums.col(column),
                    own.noise.col(column) - others.noise.col(column));
}

Measured minus_size(const RuleFit& fit, const FitData& data, const WindowSums& windows,
                    const std::vector<FitPoint>& size_points, const Bootstrap& bootstrap)
{
  const double difference = fit.value.B - estimators_of(size_points).B;
  if (bootstrap.count() == 0) return {difference};
  return {difference, error_of_minus_size(fit, data, windows,
                                          window_sums(size_points, bootstrap.runs()), bootstrap)};
}

/// Of the differences between flows, how many degrees of freedom the noise lacks.
double degrees_taken_by_composition(const FitData& data)
{
  const auto size = static_cast<Eigen::Index>(data.samples.size());
  const auto flow_of_window = data.flows_of_windows();
  Eigen::VectorXd phi_large(size), weight(size);
  std::vector<std::size_t> flow;
  flow.reserve(data.samples.size());
  for (const auto& sample : data.samples) {
    const auto place = static_cast<Eigen::Index>(flow.size());
    phi_large[place] = sample.phi_large;
    weight[place] = sample.frames * sample.phi_large * (1 - sample.phi_large);
    flow.push_back(flow_of_window[sample.window]);
  }
  return degrees_of_composition(phi_large, weight, flow);
}

/// What limits the interval, mostly nothing.
std::string doubt_of(const RuleFit& fit, const FitData& data, const WindowSums& windows,
                     const Bootstrap& bootstrap)
{
  if (!std::isfinite(fit.value.B))
    return fmt::format("in none of {} layers and windows does either species bear a stress",
                       fit.points);
  if (bootstrap.count() == 0) return {};
  if (fit.over == Population::windows) return bootstrap.doubt_of_windows(fit.dependence);
  const auto flows = data.number_of_flows();
  if (flows == 1) return bootstrap.doubt_of_runs(fit.dependence);
  const RunErrors errors(data, windows.weight());
  if (fit.over == Population::compositions) {
    const auto column = column_of_estimator(&Estimators::B);
    const double chance = errors.chance_of_likeness(influences_of(windows).noise.col(column),
                                                    degrees_taken_by_composition(data));
    if (chance >= 0.05) return bootstrap.doubt_of_runs(fit.dependence);
    return fmt::format(
        "flows differ by more than one function of composition explains (Fisher's test: {:.2g}): "
        "over compositions the interval is too wide for these flows and too narrow for others; "
        "see those over flows, equal-flows and random-flows",
        chance);
  }
  return doubt_of_flows(fit, errors.single_runs(), flows);
}

}  // namespace

void set_error(RuleFit& fit, double Estimators::*place, const StandardError& error)
{
  const auto interval = error.interval_around(fit.value.*place);
  fit.low.*place = interval.low;
  fit.high.*place = interval.high;
  fit.error.*place = error.error;
  if (place == &Estimators::B) fit.degrees = error.degrees;
}

std::string doubt_of_flows(const RuleFit& fit, std::size_t single_runs, std::size_t flows)
{
  if (single_runs > 0)
    return fmt::format(
        "{} of {} flows {} one run: the scatter of its windows stands for that of runs, which "
        "is too narrow where runs differ",
        single_runs, flows, single_runs == 1 ? "has" : "have");
  if (!(fit.degrees <= 3.5)) return {};
  return fmt::format(
      "{} runs of {} flows leave {:.2g} degrees of freedom; more runs of each "
      "give a narrower interval",
      fit.runs, flows, fit.degrees);
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
  fit.points = points.size();
  fit.value = estimators_of(points);
  fit.dependence = common ? *common : dependence(windows, data.runs, rule.adds_up());
  fit.runs = data.runs.size();
  fit.over = resolved(settings.over, fit.runs, data.number_of_flows());
  if (bootstrap.count() > 0) add_intervals(fit, data, windows, bootstrap);
  fit.doubt = doubt_of(fit, data, windows, bootstrap);
  if (!rule.adds_up()) {
    remove_b(fit);
    return fit;
  }
  if (data.quantity == Quantity::kinetic) return fit;
  fit.minus_size =
      minus_size(fit, data, windows, fit_points(data, PartitionRule{}, settings), bootstrap);
  if (data.species.size() > 2) return fit;
  fit.share = share_of_large(data, points, settings);
  fit.neutral = neutral_mean(points, rule);
  if (!common) fit.line = line_over_share(data, settings, bootstrap, fit.over);
  return fit;
}

}  // namespace grseg
