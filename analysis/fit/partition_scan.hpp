// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/rule_fit.hpp"

#include <functional>
#include <string>
#include <vector>

namespace grseg {

/// The shares p0, p0 + dp, ... up to and including p1.
struct ScanRange {
  double first = 0, last = 0, step = 0;

  std::vector<double> shares() const;
};
/// "0.4:0.9:0.005"; UsageError otherwise.
ScanRange parse_scan(const std::string& text);

/// Where B(p) is 0, p being the share that the large grain of a mixed contact gets.
struct ZeroOfB {
  double p_zero = Estimators::nan;  // p*: B_half(p) = 0; NaN: not in range
  double dB_dp = Estimators::nan;   // of B_half, at p_zero
  Interval p_zero_interval{Estimators::nan, Estimators::nan};
  Interval dB_dp_interval{Estimators::nan, Estimators::nan};
};

/// B as a function of the share p.
struct PartitionScan : ZeroOfB {
  std::vector<RuleFit> fits;  // uniform:p, one per share
  Dependence dependence;      // common to all fits, see scan_partition
  Measured p_zero_sums;       // where B_sums = 0, with the dependence at the share nearest to B = 0
};

/// p* and what B does there, looked for between the shares of `range`.
ZeroOfB find_zero_of_b(const FitData& data, const ScanRange& range, const FitSettings& settings,
                       const Bootstrap& bootstrap);

/// The band of B(p) must not jump where the block length of a single fit would, so all shares have
/// one: that of the share nearest to B = 0, with the longest autocorrelation time of all. The
/// intervals of p_zero and dB_dp are those of a fit at p_zero, whatever the range. `tell` is told,
/// now and then, how many shares are done.
PartitionScan scan_partition(const FitData& data, const ScanRange& range,
                             const FitSettings& settings, const Bootstrap& bootstrap,
                             const std::function<void(double shares)>& tell = {});

}  // namespace grseg
