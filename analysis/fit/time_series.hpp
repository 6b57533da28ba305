// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/frames/sums.hpp"

#include <vector>

namespace grseg {

/// A row for each window: run, t0 and t1 (s), B by each rule, phi_L of the fitted layers, the numbers
/// of WindowMotion, and |sigma_xy|/sigma_yy. NaN where the tables do not tell. `tables` are the tables
/// from which `data` was selected.
std::vector<std::vector<Cell>> time_series(const std::vector<FitTable>& tables, const FitData& data,
                                           const std::vector<PartitionRule>& rules,
                                           const FitSettings& settings);

}  // namespace grseg
