// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/mercury/mercury_blocks.hpp"
#include "formats/import/mercury/mercury_restart.hpp"

namespace grseg {

/// The contacts of a block of .fstat, whose rows of grains are those of `moment`:
/// * Force on i = fn n + ft t, n from j to i; at a wall n and t have the opposite signs.
/// * Most pairs stand in two rows, (i, j) and (j, i), those with a fixed grain or across a periodic
///   boundary in one: the first row is used, with its whole force.
/// * Branch = n (r_i + r_j - delta): x_i - x_j is not the branch across a periodic boundary. A
///   wall's contact point is where it cuts its normal through the grain, at r_i - delta.
/// FormatError naming the row where the two do not belong together. Unless `period_is_known`, a
/// pair that is too far apart to touch is refused.
void add_mercury_contacts(const MercuryForces& rows, bool period_is_known, ArchiveMoment& moment);

/// The contacts of the block Interactions, between grains of `moment` by their ids. Overlap and
/// branch of two grains are those of their positions. `path` is for sentences.
void add_mercury_contacts(const MercuryRestart& restart, const std::string& path,
                          ArchiveMoment& moment);

}  // namespace grseg
