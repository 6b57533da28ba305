// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/export/view_cell.hpp"
#include "formats/trajectory/reader.hpp"

#include <memory>
#include <string>

namespace grseg {

/// Writes frames of a run for other programs. The output appears whole after publish(), or not at
/// all.
class RunWriter {
 public:
  RunWriter() = default;
  RunWriter(const RunWriter&) = delete;
  RunWriter& operator=(const RunWriter&) = delete;
  virtual ~RunWriter() = default;

  /// Adds a frame with velocities, images and contacts, and with forces if the run has them.
  virtual void add(const Frame<2>& frame) = 0;
  virtual void add(const Frame<3>& frame) = 0;
  virtual void publish() = 0;
  /// The grseg-import command that turns the output back into a run, with options for the facts
  /// that the format cannot store; "" if there is none. Valid after all frames have been added.
  virtual std::string import_command() const { return ""; }
};

// Each function returns a writer to `path`, which may not be the run itself and is replaced only
// with `overwrite`. `cell` is the same for all frames.

/// Two LAMMPS dumps (doc/src/dump.rst); each frame is a block with ITEM: TIME and the frame's step
/// as TIMESTEP:
///   PATH            dump custom: id type mass radius x y z ix iy iz vx vy vz omegaz [fx fy fz];
///                   positions are wrapped into the cell, ix iy iz count the periods to add; type 1
///                   is the smallest species, the last type the boundary; spheres also have omegax
///                   and omegay
///   PATH.contacts   (before the ending) dump local: index batom1 batom2 dist, the normal force
///                   fx fy fz and the tangential force p1 p2 p3 on batom1, in the order of
///                   property/local and pair/local (OVITO knows batom1, batom2, dist by name); then
///                   forcex forcey, their sum to the last bit, branchx branchy (for spheres also
///                   forcez and branchz), overlap = -gap, and wall
/// A contact with a straight wall names its grain twice, because OVITO stops if a partner is not a
/// grain. Its column `wall` has the number of the wall; other contacts have -1. Reals have the
/// fewest digits from which the same double is read.
std::unique_ptr<RunWriter> lammps_writer(const TrajectoryReader& run, const ViewCell& cell,
                                         const std::string& path, bool overwrite);

/// Extended XYZ for OVITO and ASE. A frame is the number of present grains, a line of keys, and a
/// row for each of these grains. Types are numbers (1 the smallest species, the last one the
/// boundary), because ASE accepts only chemical symbols as species. Columns have the names that both
/// programs read: velo and mass (OVITO), masses and momenta (ASE). Reals have the fewest digits
/// from which the same double is read; discs have z = 0. The format cannot store contacts.
std::unique_ptr<RunWriter> extxyz_writer(const TrajectoryReader& run, const ViewCell& cell,
                                         const std::string& path, bool overwrite);

/// H5MD 1.1 for MDAnalysis' H5MDReader, which requires three dimensions: vectors of discs have z =
/// 0. The group is /particles/trajectory, and box/edges has one matrix per frame. The elements of
/// particles have no `unit`, because the reader rejects metres (and strings of fixed length, which
/// H5MD demands). So open the file with convert_units=False; numbers are SI, as
/// /h5md/modules/units states. Stored are position, velocity, force (if the run has it), image and
/// angular_velocity (for discs about z, [F][N]), and for each grain id, species, radius and mass.
/// H5MD has a fixed number of particles, so a grain that is absent in a frame is NaN there.
/// /observables are copied from the run. The format cannot store contacts.
std::unique_ptr<RunWriter> h5md3d_writer(const TrajectoryReader& run, const ViewCell& cell,
                                         const std::string& path, bool overwrite);

/// A folder for ParaView: grains.pvd and contacts.pvd, each a list of times and files.
///   grains/      a vertex per present grain, with radius and diameter (to scale glyphs), mass,
///                species (0 the smallest, the last one the boundary), id, velocity,
///                angular_velocity (of discs about z), force
///   contacts/    a line per contact from x_i to x_i - branch, with its own end points: at the
///                periodic edge the line leaves the cell instead of crossing the picture, and at a
///                wall it ends at the contact point. Points have normal_force (for tubes). Lines
///                have normal_force, force, tangential_force (for spheres its modulus), gap,
///                pair_type (0 SS, 1 LS, 2 LL, 3 Sb, 4 Lb) and the ids i and j (-1 for wall 0, -2
///                for wall 1). Unless there are exactly two species, species_i and species_j
///                replace pair_type; a wall counts as boundary
/// Reals are single precision.
std::unique_ptr<RunWriter> vtp_writer(const TrajectoryReader& run, const ViewCell& cell,
                                      const std::string& path, bool overwrite);

}  // namespace grseg
