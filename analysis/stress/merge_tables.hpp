// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Several tables of grseg-stress, or of several of them, as one: rows of one window (t0, t1) and
/// layer become their mean weighted by frames, and `frames` their sum. A layer that a run does not
/// reach counts as empty in all of that run's frames. With `all_windows` all windows become one,
/// from the earliest t0 to the latest t1.
///
/// The # lines hold every table's history and input, and last `command`; all others must be the
/// same in all tables: FormatError naming two that differ. UsageError where two hold the same time
/// of the same run. The result does not depend on the order of `tables` (but for file names in
/// `command`).
Table merge_tables(std::vector<Table> tables, bool all_windows, const ToolInfo& info,
                   const std::string& command);

}  // namespace grseg
