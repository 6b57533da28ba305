// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/estimators.hpp"
#include "analysis/statistics/bootstrap.hpp"
#include "analysis/statistics/confidence.hpp"

#include <array>
#include <optional>
#include <string>

namespace grseg {

/// What one partition rule makes of the data of two species. `share` and `neutral` are known only
/// where there is no third one.
struct RuleFit {
  PartitionRule rule;
  std::size_t points = 0;          // with both stresses positive
  std::size_t not_positive = 0;    // the others
  double share = Estimators::nan;  // of the mixed contacts' stress given to large grains, drop: NaN
  Over over = Over::windows;       // what the intervals of 95 % are over
  std::optional<std::size_t> mixture;  // number of the one that the fit is of; none: of all
  std::size_t runs = 0;
  Estimators value, low, high, error;
  double degrees = Estimators::nan;  // of freedom of the interval of B_half
  Interval B_half_windows{Estimators::nan, Estimators::nan};  // by the windows' scatter inside runs
  // B_half and B_sums over each population, as far as they are known: see at() and sums_at().
  using Populations = std::array<Estimate, std::size(overs) + 1>;
  Populations B_over = {}, B_sums_over = {};
  Estimate& at(Over population) { return B_over[static_cast<std::size_t>(population)]; }
  const Estimate& at(Over population) const { return B_over[static_cast<std::size_t>(population)]; }
  Estimate& sums_at(Over population) { return B_sums_over[static_cast<std::size_t>(population)]; }
  const Estimate& sums_at(Over population) const
  {
    return B_sums_over[static_cast<std::size_t>(population)];
  }
  // The share of every mixed contact at which B_sums = 0, whatever the fit's rule; of contact stress
  // and two species.
  Estimate p_zero_sums = {};
  StandardError p_zero_sums_error{Estimators::nan, 0};
  // B_half of the normal stress sigma_yy and of the pressure; not a number where a sum was not kept.
  Estimate B_yy = {}, B_pressure = {};
  double neutral = Estimators::nan;
  double minus_size = Estimators::nan;  // B_direct less that of rule size, same samples
  Interval minus_size_interval{Estimators::nan, Estimators::nan};
  Dependence dependence;
  std::string doubt;  // a sentence on the intervals, mostly empty
  SpeciesPair pair = {};
  std::optional<Estimate> size_exponent = {};  // of all pairs together (size_exponent.hpp)
};

/// How far the windows are from independent under this rule.
Dependence dependence(const FitData& data, const PartitionRule& rule, const FitSettings& settings);

/// Gives an estimator its error and interval.
void set_error(RuleFit& fit, double Estimators::*place, const StandardError& error);

/// For `drop` every B is NaN: its partial stresses do not add up to the whole. `common`: where
/// several fits are to share it; otherwise the dependence is that of the fit. Over equal or random
/// mixtures the intervals are those over these mixtures: see fit_mixtures.hpp.
RuleFit fit_rule(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                 const Bootstrap& bootstrap, const std::optional<Dependence>& common = {});

}  // namespace grseg
