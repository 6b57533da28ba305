// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// Output of --columns: a paragraph for each placeholder and each column of the tables that the
/// tool prints, "NAME[unit], 3D NAME[unit]: meaning [equation]". Empty for a tool without tables.
/// The definitions are in columns.tsv, the only place that defines columns.
std::string columns_text(const std::string& tool);

}  // namespace grseg
