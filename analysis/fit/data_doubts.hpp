// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Reasons why windows and runs may not be independent, or why layers mean little, one sentence each;
/// usually an empty list. Reasons are: two runs that may be the same run, flows that share a run, a
/// mean of several runs, windows between which no grain moves, and layers that cross a flow and
/// grains at rest.
std::vector<std::string> doubts_of_tables(const std::vector<Table>& tables,
                                          const std::vector<FitTable>& read, const FitData& data);

}  // namespace grseg
