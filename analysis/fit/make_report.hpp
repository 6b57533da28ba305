// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_options.hpp"
#include "analysis/fit/fit_report.hpp"
#include "formats/cli/table.hpp"

#include <string>
#include <vector>

namespace grseg {

/// All that grseg-fit prints of these tables, without the command at hand in its history. UsageError
/// where the options and the tables do not fit each other, FormatError where a table lacks what is asked for.
FitReport make_report(const ToolInfo& info, const FitOptions& options, const std::string& preset,
                      const std::vector<Table>& tables);

}  // namespace grseg
