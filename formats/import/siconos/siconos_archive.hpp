// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <memory>

namespace grseg {

/// The HDF5 file of a Siconos run of discs or spheres (siconos.io.mechanics_run 4.4,
/// output_contact_forces), a contact-dynamics program: rows of /data/dynamic, /data/velocities and
/// /data/cf are found by their times, in single precision. `files.grains` names the one file.
///
/// * Forces: /data/cf holds impulses of a step on body ds1, so force = impulse / step. The step is
///   not in the file; it follows from /data/solv, which has a row per step that was written.
/// * Moments: the times of /data/dynamic but the first: a step was solved at each. The initial state
///   has no contacts. Where it was taken away, its place is taken by the first step, of which remarks()
///   says that it is left out.
/// * Partners: ds1 == ds2 means that the partner is static: the static disc, box or convex hull that
///   the row's second point lies on. Static discs are grains with `fixed` set; they get the density
///   of the first mobile grain, and their ids, which are negative, become numbers after the last
///   mobile one. Boxes and hulls are walls, numbered in the order in which they were added.
/// * Points: a sphere and a box may touch in several; their impulses are added.
/// * A contact that has just opened stays in the table for one more step, with the geometry and
///   relative velocity of the step before and an impulse that acted on no body. Such rows are left
///   out; they can be recognised only where every step was written (output_frequency 1). Otherwise
///   they stay, which remarks() says.
/// * force of a grain: m (v - v of the step before) / step where every step was written.
///
/// Gravity is a Python function and not in the file. Units: as the run had them, SI by habit.
std::unique_ptr<Archive> open_siconos(const ArchiveFiles& files);

extern const ArchiveFormat siconos_format;

}  // namespace grseg
