// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/table.hpp"

#include <vector>

namespace grseg {

/// UsageError where two tables hold the same time of the same run, which would count twice: one
/// input is common to both and their windows overlap, or all rows of a window are the same in both
/// to the last bit, whatever their inputs are called.
void require_distinct_runs(const std::vector<Table>& tables);

}  // namespace grseg
