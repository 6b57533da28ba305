// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/rule_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// Sets B and paper_B to NaN, which have no meaning if the partial stresses do not add up.
void remove_b(RuleFit& fit)
{
  for (auto* all : {&fit.value, &fit.low, &fit.high, &fit.error}) all->B = all->paper_B = no_number;
  fit.B_over.fill({});
}

/// Sets the intervals of all estimators over fit.over, and B over every population that the data
/// allow.
void add_intervals(RuleFit& fit, const FitData& data, const WindowSums& windows)
{
  for (const auto& [name, place] : estimator_columns) {
    const Errors errors(data, windows, place);
    const auto influence = influence_on(place, windows);
    set_error(fit, place, errors.over(fit.over, influence));
    if (place != &Estimators::B) continue;
    std::vector<Population> known{Population::windows};
    if (fit.runs > 1)
      known.push_back(data.number_of_flows() > 1 ? Population::flows : Population::runs);
    for (const auto over : known) fit.at(over) = errors.over(over, influence).around(fit.value.B);
  }
}

/// doubt_of_runs, with what these very runs tell.
std::string doubt_of_few_runs(const Eigen::VectorXd& weight)
{
  const auto doubt = doubt_of_runs(weight);
  return doubt.empty() ? doubt : doubt + "; --over windows gives the scatter within these runs";
}

/// Warning about the interval of B, usually "".
std::string doubt_of(const RuleFit& fit, const FitData& data, const WindowSums& windows)
{
  if (!std::isfinite(fit.value.B))
    return fmt::format("no species bears a stress in any of the {} layers and windows", fit.points);
  const Eigen::VectorXd weight = windows.weight();
  if (fit.over == Population::windows)
    return doubt_of_windows(windows.excess_noise(), weight, data.runs);
  const auto flows = data.number_of_flows();
  if (flows == 1) return doubt_of_few_runs(by_run(weight, data.runs));
  return doubt_of_flows(fit, Errors(data, windows).single_runs(), flows);
}

/// Largest part of B that gradients inside the layers can add. If phi_L, phi_S and the stress are
/// positive and linear in a layer, |phi_L'| h/2 <= min(phi_L, phi_S) and |sigma'| h/2 <= sigma, so
/// that they add at most 2/3 (Thickness).
constexpr double most_of_thickness = 2.0 / 3;

/// Warning that B lies beyond its bounds, usually "".
std::string doubt_of_bounds(const RuleFit& fit, const std::vector<FitPoint>& points)
{
  const auto [least, most] = bounds_of_b(points);
  if (!(fit.value.B < least) && !(fit.value.B > most)) return {};
  const bool by_thickness = std::abs(fit.of_thickness) > most_of_thickness;
  return fmt::format(
      "B = {:.3g} is impossible: large grains bear at least none and at most all of the stress, so "
      "that B of these compositions lies between {:.2g} and {:.2g}{}",
      fit.value.B, least, most,
      by_thickness ? ""
                   : "; some stresses are negative or noise: take longer windows, or layers and "
                     "--heights with more contacts");
}

/// B of the layers' means minus B (Thickness).
double part_of_thickness(const FitData& data, const PartitionRule& rule, FitSettings settings)
{
  settings.thickness = Thickness::removed;
  const auto removed = fit_points(data, rule, settings);
  auto kept = removed;
  for (auto& point : kept) point.within = 0;
  return estimators_of(kept).B - estimators_of(removed).B;
}

/// Warning that gradients inside the layers move B by more than half its interval, or by more than
/// they can, usually "".
std::string doubt_of_thickness(const RuleFit& fit, const FitSettings& settings)
{
  if (std::abs(fit.of_thickness) > most_of_thickness)
    return fmt::format(
        "by differences to the next layers, gradients inside the layers add {:.2g} to B of their "
        "means, but straight profiles add at most 2/3: {}; take thinner layers, or cells with more "
        "grains",
        fit.of_thickness,
        settings.thickness == Thickness::kept ? "do not use --thickness removed here"
                                              : "B is wrong; --thickness kept leaves this term in");
  if (!(std::abs(fit.of_thickness) > (fit.high.B - fit.low.B) / 2)) return {};
  return fmt::format(
      "gradients inside the layers {} {:.2g} to B of their means, more than half the interval; {}",
      settings.thickness == Thickness::kept ? "add" : "would add", fit.of_thickness,
      settings.thickness == Thickness::kept
          ? "--thickness removed takes it out"
          : "thinner layers need less of this correction (grseg-stress --assign branch --layer 1dS)");
}

/// Points under the rule uniform:share.
std::vector<FitPoint> points_at(const FitData& data, double share, const FitSettings& settings)
{
  return fit_points(data, {PartitionRule::Kind::uniform, share}, settings);
}

/// True if B(p) is a straight line: if the total stress does not depend on p (LineOverShare).
bool is_straight(const FitData& data)
{
  return data.species.size() == 2 && std::ranges::none_of(data.rows, &ContactSums<3>::at_centres);
}

/// Sums by window at one share p, from which B(p) and its slope follow.
struct AtShare {
  WindowSums value;       // sums of psi_L - phi_L
  WindowSums derivative;  // the same sums with d psi_L/dp in place of psi_L - phi_L
};

AtShare at_share(const FitData& data, double share, const FitSettings& settings)
{
  const auto none = points_at(data, 0, settings), all = points_at(data, 1, settings);
  const auto points = points_at(data, share, settings);
  auto slopes = points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto own = [k](const std::vector<FitPoint>& at) {
      return at[k].large - at[k].within * at[k].total;
    };
    const double large = own(all) - own(none), total = all[k].total - none[k].total;
    const double psi = own(points) / points[k].total;
    slopes[k].large = slopes[k].phi_large + (large - psi * total) / points[k].total;
    slopes[k].total = points[k].total > 0 ? 1 : 0;
    slopes[k].within = 0;
  }
  return {window_sums(points, data.runs), window_sums(slopes, data.runs)};
}

/// The share p at which B(p) = b, by Newton's method from `share`: one step if B(p) is a straight
/// line.
double share_with(double b, double share, const FitData& data, const FitSettings& settings)
{
  for (int step = 0; step < 8 && std::isfinite(share); ++step) {
    const auto at = at_share(data, share, settings);
    const double change =
        (at.value.excess().sum() - b * at.value.weight().sum()) / at.derivative.excess().sum();
    if (!std::isfinite(change)) return change;
    share -= change;
    if (std::abs(change) < 1e-14) break;
  }
  return share;
}

/// The share p at which uniform:p gives the B of `points`. If B(p) is a straight line, it is
/// (B - B(0))/(B(1) - B(0)).
double share_of_large(const FitData& data, const std::vector<FitPoint>& points,
                      const FitSettings& settings)
{
  const auto none = points_at(data, 0, settings), all = points_at(data, 1, settings);
  double given = 0, mixed = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!(points[k].total > 0)) continue;
    given += points[k].frames * (points[k].excess() - none[k].excess());
    mixed += points[k].frames * (all[k].excess() - none[k].excess());
  }
  return is_straight(data) ? given / mixed
                           : share_with(estimators_of(points).B, given / mixed, data, settings);
}

/// Numbers under uniform:p from which a fit follows. They are linear in p if B(p) is.
struct OfShare {
  WindowSums windows;
  double of_thickness, neutral;
};

OfShare of_share(const FitData& data, double share, const FitSettings& settings)
{
  const PartitionRule rule{PartitionRule::Kind::uniform, share};
  const auto points = fit_points(data, rule, settings);
  return {window_sums(points, data.runs), part_of_thickness(data, rule, settings),
          data.species.size() > 2 ? no_number : neutral_mean(points, rule)};
}

OfShare between(const OfShare& none, const OfShare& all, double share)
{
  OfShare at = none;
  at.windows.sums += share * (all.windows.sums - none.windows.sums);
  at.windows.noise += share * (all.windows.noise - none.windows.noise);
  at.of_thickness += share * (all.of_thickness - none.of_thickness);
  at.neutral += share * (all.neutral - none.neutral);
  return at;
}

/// B with its interval over settings.over, and doubts; no other estimator.
RuleFit fit_of_b(const FitData& data, double share, const OfShare& numbers,
                 const FitSettings& settings)
{
  const auto& windows = numbers.windows;
  RuleFit fit;
  fit.rule = {PartitionRule::Kind::uniform, share};
  fit.pair = data.samples.front().pair;
  fit.points = data.samples.size();
  fit.runs = data.runs.size();
  fit.over = resolved(settings.over, fit.runs, data.number_of_flows());
  fit.value.B = estimators_from_sums(windows.total()).B;
  set_error(fit, &Estimators::B,
            Errors(data, windows).over(fit.over, influence_on(&Estimators::B, windows)));
  fit.neutral = numbers.neutral;
  fit.of_thickness = numbers.of_thickness;
  fit.doubt = doubt_of(fit, data, windows);
  add_doubt(fit, doubt_of_thickness(fit, settings));
  return fit;
}

}  // namespace

void set_error(RuleFit& fit, double Estimators::*place, const StandardError& error)
{
  const auto estimate = error.around(fit.value.*place);
  fit.low.*place = estimate.low;
  fit.high.*place = estimate.high;
  fit.error.*place = error.error;
  if (place == &Estimators::B) fit.degrees = error.degrees;
}

std::string doubt_of_flows(const RuleFit& fit, std::size_t single_runs, std::size_t flows)
{
  if (single_runs > 0)
    return fmt::format(
        "{} of {} flows {} one run: the scatter of its windows replaces the scatter of runs, and the "
        "interval is too narrow if runs differ",
        single_runs, flows, single_runs == 1 ? "has" : "have");
  if (!(fit.degrees <= 3.5)) return {};
  return fmt::format(
      "{} runs of {} flows leave {:.2g} degrees of freedom; more runs of each flow "
      "give a narrower interval",
      fit.runs, flows, fit.degrees);
}

std::string doubt_of_zero(const Estimate& zero)
{
  if (!(zero.low < 0) && !(zero.high > 1)) return {};
  if (zero.high < 0 || zero.low > 1)
    return fmt::format(
        "p* = {:.3g} lies outside 0 to 1: no rule that splits mixed contacts makes B zero",
        zero.value);
  return fmt::format(
      "the interval of p*, [{:.3g}, {:.3g}], reaches beyond 0 to 1, where the shares of all rules "
      "lie: these data do not determine p*",
      zero.low, zero.high);
}

void add_doubt(RuleFit& fit, const std::string& doubt)
{
  if (!fit.doubt.empty() && !doubt.empty()) fit.doubt += "; ";
  fit.doubt += doubt;
}

RuleFit fit_rule(const FitData& data, const PartitionRule& rule, const FitSettings& settings)
{
  const auto points = fit_points(data, rule, settings);
  const auto windows = window_sums(points, data.runs);
  RuleFit fit;
  fit.rule = rule;
  fit.pair = data.samples.front().pair;
  fit.points = points.size();
  fit.value = estimators_of(points);
  fit.runs = data.runs.size();
  fit.over = resolved(settings.over, fit.runs, data.number_of_flows());
  add_intervals(fit, data, windows);
  fit.doubt = doubt_of(fit, data, windows);
  if (!rule.adds_up()) {
    remove_b(fit);
    return fit;
  }
  fit.of_thickness = part_of_thickness(data, rule, settings);
  add_doubt(fit, doubt_of_bounds(fit, points));
  add_doubt(fit, doubt_of_thickness(fit, settings));
  if (data.quantity == Quantity::kinetic) return fit;
  fit.minus_size = minus(fit, data, windows, fit_points(data, PartitionRule{}, settings));
  if (data.species.size() > 2) return fit;
  fit.share = share_of_large(data, points, settings);
  fit.neutral = neutral_mean(points, rule);
  return fit;
}

std::vector<RuleFit> fit_shares(const FitData& data, const std::vector<double>& shares,
                                const FitSettings& settings,
                                const std::function<void(double shares)>& tell)
{
  std::optional<OfShare> none, all;
  if (is_straight(data)) {
    none = of_share(data, 0, settings);
    all = of_share(data, 1, settings);
  }
  std::vector<RuleFit> fits;
  for (const double share : shares) {
    const auto numbers = none ? between(*none, *all, share) : of_share(data, share, settings);
    fits.push_back(fit_of_b(data, share, numbers, settings));
    if (tell) tell(static_cast<double>(fits.size()));
  }
  return fits;
}

Measured minus(const RuleFit& fit, const FitData& data, const WindowSums& windows,
               const std::vector<FitPoint>& others)
{
  constexpr auto b = &Estimators::B;
  const auto influence = influence_on(b, windows) - influence_on(b, window_sums(others, data.runs));
  return {fit.value.B - estimators_of(others).B, Errors(data, windows).over(fit.over, influence)};
}

// Influence of a window w is E_w/(-dE/dp) on p* and (dE_w/dp - dB/dp Q_w)/Q on dB/dp. E is the sum
// of psi_L - phi_L over frames and layers, Q the sum of phi_L phi_S; E_w and Q_w are sums over w.
// Errors subtracts multiples of the weights Q_w itself.
LineOverShare line_over_share(const FitData& data, const FitSettings& settings, Population over)
{
  if (data.quantity != Quantity::contact || data.species.size() > 2) return {};
  const double zero = share_with(0, 0.5, data, settings);
  if (!std::isfinite(zero)) return {};
  const auto at = at_share(data, zero, settings);
  const Eigen::VectorXd weight = at.value.weight();
  const double change = at.derivative.excess().sum(), slope = change / weight.sum();
  const Errors errors(data, at.value);
  return {
      {zero, errors.over(over, {at.value.excess() / -change, at.value.excess_noise() / -change})},
      {slope, errors.over(over, {at.derivative.excess() / weight.sum(),
                                 at.derivative.excess_noise() / weight.sum()})}};
}

}  // namespace grseg
