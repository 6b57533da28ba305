// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/estimators.hpp"
#include "analysis/fit/fit_data.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/statistics/confidence.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// B as a function of the share p of every mixed contact that its large grain gets. For two species
/// it is a straight line, B = dB_dp (p - p_zero), since sigma^L is linear in p and B in sigma^L. If
/// contacts are counted at the grains' centres (--assign grain), the total stress of a layer
/// depends on p, too; the line is then the tangent of B(p) at B = 0.
struct LineOverShare {
  Measured p_zero;  // p*, the share at which B = 0
  Measured dB_dp;
};

/// The fit of one partition rule to the data of two species. `share`, `neutral` and `line` are
/// NaN if the tables have a third species.
struct RuleFit {
  PartitionRule rule;
  std::size_t points = 0;                 // number of samples: layers x windows
  double share = no_number;               // uniform share p that gives the same B; drop: NaN
  Population over = Population::windows;  // population of the 95 % intervals
  std::optional<std::size_t> flow;        // index of the flow; none: fit of all flows
  std::size_t runs = 0;                   // number of runs
  Estimators value, low, high, error;     // estimates, ends of their intervals, standard errors
  double degrees = no_number;             // degrees of freedom of the interval of B
  Estimate estimate(double Estimators::*place) const
  {
    return {value.*place, low.*place, high.*place};
  }
  // B with its interval over each population, NaN if unknown; read through at().
  std::array<Estimate, std::size(populations) + 1> B_over = {};
  Estimate& at(Population population) { return B_over[static_cast<std::size_t>(population)]; }
  const Estimate& at(Population population) const
  {
    return B_over[static_cast<std::size_t>(population)];
  }
  LineOverShare line = {};          // B(p); the same for every rule
  double neutral = no_number;       // B of contacts that ignore grain size (partition_rule.hpp)
  double of_thickness = no_number;  // B of the layers' means minus B (Thickness)
  Measured minus_size = {};         // B minus B by size, from the same samples
  Measured minus_other = {};  // B minus B of another reading of the same runs (two_readings.hpp)
  std::string doubt;          // warnings about the intervals, usually empty
  SpeciesPair pair = {};
  std::optional<Estimate> size_exponent = {};  // exponent over all pairs (fit_pairs.hpp)
};

/// Stores the error and the interval of an estimator in `fit`.
void set_error(RuleFit& fit, double Estimators::*place, const StandardError& error);

/// Warning about an interval over runs of several flows: some flows have a single run, or there are
/// few degrees of freedom. Usually "".
std::string doubt_of_flows(const RuleFit& fit, std::size_t single_runs, std::size_t flows);

/// Warning that the 95 % interval of p* leaves 0 to 1, usually "". The share of a mixed contact
/// lies between 0 and 1 for every rule that splits its stress.
std::string doubt_of_zero(const Estimate& zero);

/// Appends a sentence to fit.doubt.
void add_doubt(RuleFit& fit, const std::string& doubt);

/// Fits one rule. For `drop` every B is NaN, because its partial stresses do not add up to the
/// whole. The line, and intervals over equal or random flows, are added by fit_flows (fit_pairs.hpp).
RuleFit fit_rule(const FitData& data, const PartitionRule& rule, const FitSettings& settings);

/// Fits uniform:p for each of `shares`: of the estimators only B, with its interval over
/// settings.over. If B(p) is a straight line, so are all sums, and the stresses are read at two
/// shares alone. `tell` is called with the number of shares done so far.
std::vector<RuleFit> fit_shares(const FitData& data, const std::vector<double>& shares,
                                const FitSettings& settings,
                                const std::function<void(double shares)>& tell = {});

/// B of the fit minus B of `others`, points in the same windows, over the population of the fit.
/// `windows` are sums of the fit's own points.
Measured minus(const RuleFit& fit, const FitData& data, const WindowSums& windows,
               const std::vector<FitPoint>& others);

/// p* and dB/dp, for contact stress and two species; otherwise NaN. Errors are over the population
/// `over`.
LineOverShare line_over_share(const FitData& data, const FitSettings& settings, Population over);

}  // namespace grseg
