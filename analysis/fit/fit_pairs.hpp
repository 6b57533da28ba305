// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/rule_fit.hpp"
#include "analysis/statistics/confidence.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace grseg {

/// The exponent a of a partition of stress by a power of grain size,
///   sigma^nu/sigma = phi^nu s_nu^a / sum over mu of phi^mu s_mu^a,   s: nominal diameter
/// (Marks, Rognon & Einav 2012; Tunuguntla, Bokhove & Thornton 2014). a = 0 if each species bears
/// stress in proportion to its volume, and 1, 2 or 3 if in proportion to its volume times the
/// diameter, surface or volume of one grain. For any two species ln(sigma^nu/sigma^mu) -
/// ln(phi^nu/phi^mu) = a ln(s_nu/s_mu); a is the weighted least-squares slope of this line through
/// the origin, over the samples of all pairs in `data`. For two species a = minus_ln_s/ln r
/// (estimators.hpp), r = d_L/d_S. NaN if there are no points.
Estimate size_exponent(const FitData& data, const PartitionRule& rule, const FitSettings& settings);

/// Fit of one rule to all flows together and to each flow; `of_each` is empty if there is only one.
struct FlowFits {
  RuleFit all;
  std::vector<RuleFit> of_each;
};

/// Fits one pair of species. The interval of each single flow is over the flow's runs, or over its
/// windows if it has one run, independent of settings.over.
FlowFits fit_flows(const FitData& data, const PartitionRule& rule, const FitSettings& settings);

/// Reads a pair of species from `text`, by name ("AM,SE") or by number from 1 ("1,3"). Throws
/// UsageError if `text` does not name two of `species`.
SpeciesPair parse_pair(const std::string& text, const SpeciesList& species);

/// Fits every pair under every rule, rule by rule; each pair uses its own layers and windows. With
/// `with_exponent` all fits of a rule include its size_exponent over all pairs. If settings.over is
/// automatic and there are several flows, one fit per flow precedes the fit of all flows.
std::vector<RuleFit> fit_pairs(const std::vector<FitTable>& tables, Quantity quantity,
                               const FitFilters& filters, const std::vector<SpeciesPair>& pairs,
                               const std::vector<PartitionRule>& rules, const FitSettings& settings,
                               bool with_exponent);

/// The shares p0, p0 + dp, ... up to and including p1.
struct ScanRange {
  double first = 0, last = 0, step = 0;

  std::vector<double> shares() const;
};
/// "0.4:0.9:0.005"; UsageError otherwise.
ScanRange parse_scan(const std::string& text);

/// B as a function of the share p.
struct PartitionScan {
  std::vector<RuleFit> fits;  // fits under uniform:p, one per share
  LineOverShare line;         // p* and dB/dp
};

/// fit_shares() for all shares of `range`, and the line.
PartitionScan scan_partition(const FitData& data, const ScanRange& range,
                             const FitSettings& settings,
                             const std::function<void(double shares)>& tell = {});

}  // namespace grseg
