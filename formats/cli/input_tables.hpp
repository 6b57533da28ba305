// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"

#include <vector>

namespace grseg {

/// The tables that the command line names, "-" being standard input; none where it names none.
/// Unless `quiet` a remark on standard error tells how many come from versions that wrote no
/// checksum. As Table::read.
std::vector<Table> read_tables(const ToolInfo& info, const po::variables_map& values, bool quiet);

/// What a result must say of the tables that it is made of: the lines "verified", "incomplete",
/// "undecided", "waived" and "doubt", each value once. "verified: all" only where nothing else is said.
Header trust_of(const std::vector<Table>& tables);

}  // namespace grseg
