// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/fit_pairs.hpp"
#include "analysis/fit/rule_fit.hpp"
#include "formats/cli/table.hpp"

#include <vector>

/// Comparison of two readings of the same runs, such as two thicknesses of layers. Both have the
/// same noise, so the difference of B is known better than either B.
namespace grseg {

/// Throws UsageError unless table k of `others` is of the same run as table k of `tables`, for all
/// k: of the same motion (Kinship), since other motions have other noise.
void require_same_runs(const std::vector<Table>& tables, const std::vector<Table>& others);

/// Input of fit_pairs().
struct FitSource {
  std::vector<FitTable> tables;
  Quantity quantity;
  FitFilters filters;
};

/// Sets RuleFit::minus_other of all fits of `source`: the difference of B over the windows that both
/// readings have, over the population of each fit. Throws UsageError if they have no window in
/// common, or if a fit is over equal or random flows.
void add_differences(std::vector<RuleFit>& fits, const FitSource& source, const FitSource& other,
                     const FitSettings& settings);

}  // namespace grseg
