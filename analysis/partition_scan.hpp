// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/segregation_fit.hpp"

#include <limits>
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

/// B as a function of the share p that the large grain of a mixed contact gets.
struct PartitionScan {
  std::vector<RuleFit> fits;                                 // uniform:p, one per share
  Dependence dependence;                                     // the worst of all, common to all fits
  double p_zero = std::numeric_limits<double>::quiet_NaN();  // B_half(p) = 0; NaN: not in range
  double p_low = std::numeric_limits<double>::quiet_NaN();   // where the interval of B ends at 0,
  double p_high = std::numeric_limits<double>::quiet_NaN();  // i.e. the interval of p_zero
  double dB_dp = std::numeric_limits<double>::quiet_NaN();   // of B_half, at p_zero
};

PartitionScan scan_partition(const FitData& data, const ScanRange& range,
                             const FitSettings& settings, const Bootstrap& bootstrap);

}  // namespace grseg
