// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <memory>

namespace grseg {

/// Two plain tables (csv_table.hpp), which a script can write for any program. Names of columns
/// with their synonyms; a missing component is 0:
///   grains    time|t id x y z; radius|r or diameter|d; vx vy vz, omega|wz|omegaz (also wx|omegax,
///             wy|omegay), mass|m, type|species, fixed, fx fy fz: the total force, with gravity
///   contacts  time|t i|id1 j|id2 fx fy fz: force ON i FROM j; overlap|delta|penetration; bx by bz:
///             branch x_i - x_j
/// j < 0 is straight wall -j-1, where a branch (x_i - contact point) is needed. Moments are matched
/// by time. A line "# periodic: x 0 0.35" above the names of the grains' table says that x is
/// periodic from 0 to 0.35.
std::unique_ptr<Archive> open_csv(const ArchiveFiles& files);

extern const ArchiveFormat csv_format;

}  // namespace grseg
