// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Merges tables of grseg-stress, or merged tables, into one. Rows of the same window (t0, t1) and
/// layer become one row: their mean weighted by frames, and the sum of `frames`. A layer that a run
/// does not reach counts as empty in all frames of that run. With `all_windows` all windows become
/// one, from the earliest t0 to the latest t1.
///
/// The header contains the histories and inputs of all tables, and `command` as the last line of
/// the history. All other header lines must agree in all tables. Throws FormatError, naming two
/// tables that differ, and UsageError if two tables contain the same time of the same run, or are of
/// different flows (flow_of_table.hpp). The result does not depend on the order of `tables`, except
/// for file names in `command`.
Table merge_tables(std::vector<Table> tables, bool all_windows, const ToolInfo& info,
                   const std::string& command);

}  // namespace grseg
