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

/// How samples are drawn (Bootstrap).
struct Resampling {
  std::size_t samples = 0;
  unsigned long seed = 1;
};

/// The exponent a of a partition of stress by a power of grain size,
///   sigma^nu/sigma = phi^nu s_nu^a / sum over mu of phi^mu s_mu^a,   s: nominal diameter
/// (Marks, Rognon & Einav 2012; Tunuguntla, Bokhove & Thornton 2014): 0 where stress goes by
/// volume, 1, 2 or 3 where it goes with diameter, surface or volume of the single grain. For any
/// two species ln(sigma^nu/sigma^mu) - ln(phi^nu/phi^mu) = a ln(s_nu/s_mu), and a is the weighted
/// least-squares slope of this line through the origin over the samples of all pairs in `data`. For
/// two species it is minus_ln_s/ln r (estimators.hpp), with the interval of minus_ln_s over the
/// same data; over equal or random flows it is the mean of the flows' exponents. NaN without
/// points.
Estimate size_exponent(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                       const Resampling& resampling);

/// One rule for all flows together and for each of them; the latter is empty where there is one.
struct FlowFits {
  RuleFit all;
  std::vector<RuleFit> of_each;
};

/// Fits data of one pair of species. A flow's own interval is over its runs, or over the windows of
/// a single run, whatever the interval of all flows is over.
///
/// Over equal flows each number of all is the unweighted mean of the flows' numbers, and the flows'
/// errors are added (confidence.hpp). Over random flows it is the same mean with the scatter of the
/// flows' values, n - 1 degrees of freedom for n flows. B over each stands in RuleFit::at() always.
FlowFits fit_flows(const FitData& data, const PartitionRule& rule, const FitSettings& settings,
                   const Resampling& resampling);

/// The two species that `text` names, "AM,SE" or by number from 1 "1,3", the smaller one first.
/// UsageError where it does not name two of `species`.
SpeciesPair parse_pair(const std::string& text, const SpeciesList& species);

/// Every rule for every pair, rule by rule, each pair over its own layers and windows; and, if
/// asked for, the exponent of sizes of each rule over all of these pairs. Where there are several
/// flows and `settings` leaves the population open, each flow has its own fit before the fit of
/// all.
std::vector<RuleFit> fit_pairs(const std::vector<FitTable>& tables, Quantity quantity,
                               const FitFilters& filters, const std::vector<SpeciesPair>& pairs,
                               const std::vector<PartitionRule>& rules, const FitSettings& settings,
                               const Resampling& resampling, bool with_exponent);

/// The shares p0, p0 + dp, ... up to and including p1.
struct ScanRange {
  double first = 0, last = 0, step = 0;

  std::vector<double> shares() const;
};
/// "0.4:0.9:0.005"; UsageError otherwise.
ScanRange parse_scan(const std::string& text);

/// B as a function of the share p.
struct PartitionScan {
  std::vector<RuleFit> fits;  // uniform:p, one per share
  Dependence dependence;      // common to all fits, see scan_partition
  LineOverShare line;         // with the dependence at p*
};

/// The band of B(p) must not jump where the block length of a single fit would, so all shares have
/// one: that at p*, or at the share nearest to it, with the longest autocorrelation time of all.
/// `tell` is told, now and then, how many shares are done.
PartitionScan scan_partition(const FitData& data, const ScanRange& range,
                             const FitSettings& settings, const Bootstrap& bootstrap,
                             const std::function<void(double shares)>& tell = {});

}  // namespace grseg
