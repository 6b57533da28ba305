// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <memory>

namespace grseg {

/// Runs of MercuryDPM as its source writes them (mercury_blocks.hpp, mercury_restart.hpp), in one of
/// three sets of files:
/// * .data (`files.grains`), .fstat (`files.contacts`), and .restart, which states masses, species,
///   fixed grains, gravity, step, discs or spheres and periodic boundaries. Without it the command
///   line must give them. The info column is a species only where --columns says info=species. No
///   forces on grains.
/// * .restart files alone (`files.restart`, or `files.grains`), each a whole moment.
/// * .restart files of versions 3 and 2, which have no contacts, as `files.grains`, with .fstat.
/// Moments of two tables are matched by time; the two may be saved at different times.
///
/// Not in these files: units.
std::unique_ptr<Archive> open_mercury(const ArchiveFiles& files);

extern const ArchiveFormat mercury_format;

}  // namespace grseg
