// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/estimators.hpp"
#include "analysis/fit/line_over_share.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/statistics/bootstrap.hpp"
#include "analysis/statistics/confidence.hpp"

#include <array>
#include <optional>
#include <string>

namespace grseg {

/// What one partition rule makes of the data of two species. `share`, `neutral` and `line` are known
/// only where there is no third one.
struct RuleFit {
  PartitionRule rule;
  std::size_t points = 0;    // layers and windows
  double share = no_number;  // the p that gives this B (line_over_share.hpp); drop: NaN
  Population over = Population::windows;  // what the intervals of 95 % are over
  std::optional<std::size_t> flow;        // number of the one that the fit is of; none: of all
  std::size_t runs = 0;
  Estimators value, low, high, error;
  double degrees = no_number;  // of freedom of the interval of B
  // B over each population, as far as it is known: see at().
  std::array<Estimate, std::size(populations) + 1> B_over = {};
  Estimate& at(Population population) { return B_over[static_cast<std::size_t>(population)]; }
  const Estimate& at(Population population) const
  {
    return B_over[static_cast<std::size_t>(population)];
  }
  LineOverShare line = {};  // whatever the fit's rule
  double neutral = no_number;
  Measured minus_size = {};  // B less that of rule size, same samples
  Dependence dependence;
  std::string doubt;  // a sentence on the intervals, mostly empty
  SpeciesPair pair = {};
  std::optional<Estimate> size_exponent = {};  // of all pairs together (fit_pairs.hpp)
};

/// How far the windows are from independent under this rule.
Dependence dependence(const FitData& data, const PartitionRule& rule, const FitSettings& settings);

/// Gives an estimator its error and interval.
void set_error(RuleFit& fit, double Estimators::*place, const StandardError& error);

/// What limits an interval over runs of several flows, of which some have a single one; mostly
/// nothing.
std::string doubt_of_flows(const RuleFit& fit, std::size_t single_runs, std::size_t flows);

/// Adds a sentence to the fit's doubt.
void add_doubt(RuleFit& fit, const std::string& doubt);

/// For `drop` every B is NaN: its partial stresses do not add up to the whole. `common`: where
/// several fits are to share it; otherwise the dependence is that of the fit. Over equal or random
/// flows the intervals are those over these flows: see fit_pairs.hpp.
RuleFit fit_rule(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                 const Bootstrap& bootstrap, const std::optional<Dependence>& common = {});

}  // namespace grseg
