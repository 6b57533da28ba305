// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace grseg {

/// Output of --columns: a paragraph for each placeholder and each column of the tables that the
/// tool prints, "NAME[unit], 3D NAME[unit]: meaning [equation]". Empty for a tool without tables.
/// With `names`, as printed by the tool, with or without unit ("Msize_yy"), of these columns only;
/// throws UsageError if no column has such a name. The definitions are in columns.tsv, the only
/// place that defines columns.
std::string columns_text(const std::string& tool, const std::vector<std::string>& names = {});

}  // namespace grseg
