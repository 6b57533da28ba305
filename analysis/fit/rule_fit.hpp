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
  // Of `value` by the windows' scatter inside runs; none of means over mixtures.
  Interval B_half_windows{Estimators::nan, Estimators::nan},
      B_sums_windows{Estimators::nan, Estimators::nan};
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
  Measured p_zero_sums = {};
  // B_half of the normal stress sigma_yy and of the pressure; not a number where a sum was not kept.
  Estimate B_yy = {}, B_pressure = {};
  double neutral = Estimators::nan;
  Measured minus_size = {};  // B_direct less that of rule size, same samples
  Dependence dependence;
  std::string doubt;  // a sentence on the intervals, mostly empty
  SpeciesPair pair = {};
  std::optional<Estimate> size_exponent = {};  // of all pairs together (size_exponent.hpp)
};

/// How far the windows are from independent under this rule.
Dependence dependence(const FitData& data, const PartitionRule& rule, const FitSettings& settings);

/// Gives an estimator its error and interval.
void set_error(RuleFit& fit, double Estimators::*place, const StandardError& error);

/// p* of the sums, with its error over `over`; of contact stress and two species, NaN of others.
Measured zero_of_sums(const FitData& data, const FitSettings& settings, const Bootstrap& bootstrap,
                      Over over, const Dependence& how_dependent);

/// What limits an interval over runs of several mixtures, of which some have a single one; mostly
/// nothing.
std::string doubt_of_mixtures(const RuleFit& fit, std::size_t single_runs, std::size_t mixtures);
/// Where the mean of ln(y/x) and the ratio of sums cannot both be B at all compositions, with windows
/// of so many s. Only under rules whose neutral B is 0 there: by others the two may well differ.
std::string doubt_of_logarithms(const RuleFit& fit, double window);
/// Adds a sentence to the fit's doubt.
void add_doubt(RuleFit& fit, const std::string& doubt);

/// For `drop` every B is NaN: its partial stresses do not add up to the whole. `common`: where
/// several fits are to share it; otherwise the dependence is that of the fit. Over equal or random
/// mixtures the intervals are those over these mixtures: see fit_mixtures.hpp.
RuleFit fit_rule(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                 const Bootstrap& bootstrap, const std::optional<Dependence>& common = {});

}  // namespace grseg
