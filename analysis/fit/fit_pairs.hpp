// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/fit_flows.hpp"
#include "analysis/fit/rule_fit.hpp"

#include <string>
#include <vector>

namespace grseg {

/// The two species that `text` names, "AM,SE" or by number from 1 "1,3", the smaller one first.
/// UsageError where it does not name two of `species`.
SpeciesPair parse_pair(const std::string& text, const SpeciesList& species);

/// Every rule for every pair, rule by rule, each pair over its own layers and windows; and, if
/// asked for, the exponent of sizes of each rule over all of these pairs. Where there are several
/// flows and `settings` leaves open what intervals are over, each flow has its own fit before
/// that of all.
std::vector<RuleFit> fit_pairs(const std::vector<FitTable>& tables, Quantity quantity,
                               const FitFilters& filters, const std::vector<SpeciesPair>& pairs,
                               const std::vector<PartitionRule>& rules, const FitSettings& settings,
                               const Resampling& resampling, bool with_exponent);

}  // namespace grseg
