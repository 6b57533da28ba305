// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/confidence.hpp"

#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Numbers of a whole run under their names with units, and sentences on what cannot be told.
struct SegregationSummary {
  std::vector<std::pair<std::string, Estimate>> numbers;
  std::vector<std::string> remarks;

  void append(const SegregationSummary& others)
  {
    numbers.insert(numbers.end(), others.numbers.begin(), others.numbers.end());
    remarks.insert(remarks.end(), others.remarks.begin(), others.remarks.end());
  }
};

}  // namespace grseg
