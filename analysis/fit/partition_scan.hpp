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

/// B as a function of the share p.
struct PartitionScan {
  std::vector<RuleFit> fits;  // uniform:p, one per share
  Dependence dependence;      // common to all fits, see scan_partition
  LineOverShare line;         // with the dependence at p*
};

/// The band of B(p) must not jump where the block length of a single fit would, so all shares have
/// one: that at p*, or at the share nearest to it, with the longest autocorrelation time of all. `tell`
/// is told, now and then, how many shares are done.
PartitionScan scan_partition(const FitData& data, const ScanRange& range,
                             const FitSettings& settings, const Bootstrap& bootstrap,
                             const std::function<void(double shares)>& tell = {});

}  // namespace grseg
