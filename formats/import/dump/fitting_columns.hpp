// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/dump/dump_archive.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// The value of --columns with which the forces on grains add up best, within the tolerance of the
/// format. Nothing where they do with `in_use` already, or with none. The first moments that tell are
/// read, from the files opened again; `gravity` is in the archive's axes.
std::optional<ColumnFit> fitting_columns(const std::vector<std::string>& grain_files,
                                         const std::vector<std::string>& contact_files,
                                         const DumpDialect& dialect, const std::string& in_use,
                                         const std::optional<Vec3>& gravity);

}  // namespace grseg
