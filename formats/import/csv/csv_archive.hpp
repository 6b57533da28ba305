// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <memory>

namespace grseg {

/// Two plain tables (csv_table.hpp), which a script can write for any program. Names of columns
/// with their synonyms; `files.map` gives others (csv_map.hpp); a missing component is 0:
///   grains    time|t id x y z; radius|r or diameter|d; vx vy vz, omega|wz|omegaz (also wx|omegax,
///             wy|omegay), mass|m, type|species, fixed, fx fy fz: the total force, with gravity
///   contacts  time|t i|id1 j|id2 fx fy fz: force ON i FROM j; overlap|delta|penetration; bx by bz:
///             branch x_i - x_j
/// Instead of the time there may be step|timestep|iteration|cycle, or one file per moment (
/// csv_files.hpp). j < 0 is straight wall -j-1, where a branch (x_i - contact point) is needed.
/// Moments are matched by time or step. Comments above the names of the grains' table may state
/// facts of the run (csv_comments.hpp).
std::unique_ptr<Archive> open_csv(const ArchiveFiles& files);

extern const ArchiveFormat csv_format;

}  // namespace grseg
