// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <memory>

namespace grseg {

/// .data (`files.grains`), .fstat (`files.contacts`) and .restart of MercuryDPM, as its source
/// writes them (mercury_blocks.hpp, mercury_restart.hpp). Row numbers of .data identify the grains,
/// also in .fstat and .restart.
///
/// * Force on i = fn n + ft t, n from j to i; at a wall n and t have the opposite signs.
/// * Most pairs stand in two rows, (i, j) and (j, i), those with a fixed grain or across a periodic
///   boundary in one: the first row is used, with its whole force.
/// * Branch = n (r_i + r_j - delta): x_i - x_j is not the branch across a periodic boundary. A
///   wall's contact point is where it cuts its normal through the grain, at r_i - delta.
/// * Blocks of .data and .fstat are matched by time; the two may be saved at different times.
/// * Masses, species, fixed grains, gravity, step, discs or spheres and periodic boundaries are
///   those of .restart. Without it the command line must give them, and a pair that is too far
///   apart to touch is refused. The info column is a species only where --columns says
///   info=species.
///
/// Not in these files: forces on grains, units.
std::unique_ptr<Archive> open_mercury(const ArchiveFiles& files);

extern const ArchiveFormat mercury_format;

}  // namespace grseg
