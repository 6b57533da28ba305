// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/estimators.hpp"
#include "analysis/fit/fit_data.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/statistics/bootstrap.hpp"
#include "analysis/statistics/confidence.hpp"

#include <array>
#include <optional>
#include <string>

namespace grseg {

/// B over the share p that the large grain gets of every mixed contact. Of two species it is a
/// straight line, B = dB_dp (p - p_zero), since sigma^L is linear in p and B in sigma^L. Where
/// contacts are counted at the grains' centres (--assign grain) the whole stress of a layer depends
/// on p, too, and the line is the tangent where B = 0.
struct LineOverShare {
  Measured p_zero;  // p*, where B = 0
  Measured dB_dp;
};

/// The fit of one partition rule to the data of two species. `share`, `neutral` and `line` are
/// known only where there is no third species.
struct RuleFit {
  PartitionRule rule;
  std::size_t points = 0;                 // layers and windows
  double share = no_number;               // the p that gives this B; drop: NaN
  Population over = Population::windows;  // what the intervals of 95 % are over
  std::optional<std::size_t> flow;        // number of its flow; none: of all flows
  std::size_t runs = 0;
  Estimators value, low, high, error;
  double degrees = no_number;  // of freedom of the interval of B
  Estimate estimate(double Estimators::*place) const
  {
    return {value.*place, low.*place, high.*place};
  }
  // B over each population, as far as it is known: see at().
  std::array<Estimate, std::size(populations) + 1> B_over = {};
  Estimate& at(Population population) { return B_over[static_cast<std::size_t>(population)]; }
  const Estimate& at(Population population) const
  {
    return B_over[static_cast<std::size_t>(population)];
  }
  LineOverShare line = {};  // whatever the fit's rule
  double neutral = no_number;
  Measured minus_size = {};  // B less B by size, same samples
  Dependence dependence;
  std::string doubt;  // a sentence on the intervals, mostly empty
  SpeciesPair pair = {};
  std::optional<Estimate> size_exponent = {};  // of all pairs together (fit_pairs.hpp)
};

/// How far the windows are from independent under this rule.
Dependence dependence(const FitData& data, const PartitionRule& rule, const FitSettings& settings);

/// Gives an estimator its error and interval.
void set_error(RuleFit& fit, double Estimators::*place, const StandardError& error);

/// A sentence on what limits an interval over runs of several flows, some of which have a single
/// run; mostly "".
std::string doubt_of_flows(const RuleFit& fit, std::size_t single_runs, std::size_t flows);

/// Adds a sentence to the fit's doubt.
void add_doubt(RuleFit& fit, const std::string& doubt);

/// Fits one rule. For `drop` every B is NaN: its partial stresses do not add up to the whole.
/// `common`: the dependence of windows that several fits share; otherwise the fit finds its own.
/// fit_pairs.hpp makes the intervals over equal or random flows.
RuleFit fit_rule(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                 const Bootstrap& bootstrap, const std::optional<Dependence>& common = {});

/// The line of contact stress and two species, NaN of others; errors are over `over`, with windows
/// as dependent as they are at p*.
LineOverShare line_over_share(const FitData& data, const FitSettings& settings,
                              const Bootstrap& bootstrap, Population over);

}  // namespace grseg
