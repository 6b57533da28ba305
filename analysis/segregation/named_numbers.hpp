// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/statistics/confidence.hpp"
#include "formats/cli/provenance.hpp"

#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Numbers of a whole run under their names with units, and remarks on those that the run does not
/// determine.
struct SegregationSummary {
  std::vector<std::pair<std::string, Estimate>> numbers;
  std::vector<std::string> remarks;

  void append(const SegregationSummary& others)
  {
    numbers.insert(numbers.end(), others.numbers.begin(), others.numbers.end());
    remarks.insert(remarks.end(), others.remarks.begin(), others.remarks.end());
  }
};

/// Rows of quantity, value, low and high under the header of a table, which also holds the remarks.
std::string to_tsv(const SegregationSummary& summary, Header header);
/// {"numbers": {"tau[s]": {"value", "interval"}, ...}, "remarks", "settings", "inputs", "history"}
std::string to_json(const SegregationSummary& summary, const Header& header);

}  // namespace grseg
