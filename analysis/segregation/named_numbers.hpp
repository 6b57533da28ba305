// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/statistics/confidence.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/tool.hpp"

#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Numbers of a whole run, named with units, and remarks on numbers that the run does not
/// determine.
struct NamedNumbers {
  std::vector<std::pair<std::string, Estimate>> numbers;
  std::vector<std::string> remarks;
};

/// A table with the columns quantity, value, low and high; the remarks are added to its header.
std::string to_tsv(const NamedNumbers& summary, Header header);
/// {"numbers": {"tau[s]": {"value", "interval"}, ...}, "remarks", "settings", "inputs", "history"}
std::string to_json(const NamedNumbers& summary, const Header& header);
/// Writes the table, or JSON if `json`, to the file or stream of `output`. Prints the remarks on
/// standard error, unless `quiet`.
void write_numbers(const NamedNumbers& numbers, const Header& header, const ToolInfo& info,
                   const TableOptions& output, bool json, bool quiet);

}  // namespace grseg
