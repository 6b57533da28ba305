// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/fit_report.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Options of grseg-fit, mostly as typed.
struct FitOptions {
  std::vector<std::string> partition;
  std::string component = "yy", quantity = "contact", thickness = "removed";
  std::string base, scan, ratio_range, pair, over, flows, fit;
  bool series = false;
  std::vector<std::string> minus;
  TableOptions output;
  bool json = false, quiet = false, exponent = false;
  FitFilters filters;

  po::options_description description();
  /// The tables of the chosen quantity.
  WantedTables wanted() const;
  /// Throws UsageError for invalid values, before any table is read; sets `filters`.
  void check(const po::variables_map& values);
};

/// All that grseg-fit prints for these tables. The history does not yet include the running
/// command. Throws UsageError if the options do not fit the tables, and FormatError if a table
/// lacks a column or header line that the options need.
FitReport make_report(const ToolInfo& info, const FitOptions& options, const std::string& preset,
                      const std::vector<Table>& tables);

}  // namespace grseg
