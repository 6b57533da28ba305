// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/partition_scan.hpp"
#include "analysis/fit/rule_fit.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// What grseg-fit has to say.
struct FitReport {
  std::vector<std::pair<std::string, std::string>> header;  // settings, as "# key: value"
  std::vector<std::string> inputs, history;
  Quantity quantity = Quantity::contact;
  Component component = Component::yy;
  std::vector<RuleFit> rules;
  std::optional<PartitionScan> scan;
};

/// What limits the intervals: a sentence per rule and one for the scan, mostly none. They are among
/// the lines of the table and in "doubts".
std::vector<std::string> doubts(const FitReport& report);

/// "# key: value" lines, one line of column[unit] names, a row per rule, whose name stands first;
/// with a scan instead a row per share p, with p_zero and dB_dp among the lines above.
std::string to_tsv(const FitReport& report);
/// The same as one JSON object; what is not a number is null.
std::string to_json(const FitReport& report);

}  // namespace grseg
