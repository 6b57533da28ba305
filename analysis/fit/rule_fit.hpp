// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/estimators.hpp"
#include "analysis/statistics/bootstrap.hpp"
#include "analysis/statistics/confidence.hpp"

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
  // Intervals of 95 %, of several runs by their scatter.
  Estimators value, low, high;
  Interval B_half_windows{Estimators::nan, Estimators::nan};  // by the windows' scatter inside runs
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

/// Fills in B_yy and B_pressure of a fit of the component in `settings`; the other one has the
/// dependence of its own windows.
void add_components(RuleFit& fit, const FitData& data, const FitSettings& settings,
                    const Bootstrap& bootstrap);

/// For `drop` every B is NaN: its partial stresses do not add up to the whole. `common`: where
/// several fits are to share it; otherwise the dependence is that of the fit.
RuleFit fit_rule(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                 const Bootstrap& bootstrap, const std::optional<Dependence>& common = {});

}  // namespace grseg
