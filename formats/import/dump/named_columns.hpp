// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/dump/dump_reader.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// What `fx fy fz` of contacts are where other columns hold the tangential force.
enum class PlainForce { normal, whole };

/// The mapping (contact_columns.hpp) of columns that are named by what they hold, by `dump_modify
/// colname` or a script: "id1 id2 dist fnx fny fnz ftx fty ftz". "" where two ids and a force are not
/// among the names.
std::string columns_by_name(const DumpHeader& header, PlainForce plain);

/// Names as they are compared: letters and digits alone, in lower case.
std::string compared_name(std::string_view name);

}  // namespace grseg
