// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Reasons why windows and runs may not be independent, a sentence each, mostly none: runs that nothing
/// tells apart, flows that share a run, windows between which nothing moves.
std::vector<std::string> doubts_of_tables(const std::vector<Table>& tables,
                                          const std::vector<FitTable>& read, const FitData& data);

}  // namespace grseg
