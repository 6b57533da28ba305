// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/export/view_cell.hpp"
#include "formats/trajectory/reader.hpp"

#include <memory>
#include <string>

namespace grseg {

/// Writes frames of a run for other programs. What is written appears whole when it is published,
/// or not at all.
class RunWriter {
 public:
  RunWriter() = default;
  RunWriter(const RunWriter&) = delete;
  RunWriter& operator=(const RunWriter&) = delete;
  virtual ~RunWriter() = default;

  /// Needs velocities, images, contacts, and forces where the run has them.
  virtual void add(const Frame<2>& frame) = 0;
  virtual void add(const Frame<3>& frame) = 0;
  virtual void publish() = 0;
  /// The command that turns what was written back into a run, with options for what it cannot hold;
  /// "" where there is none. Valid when all frames have been added.
  virtual std::string import_command() const { return ""; }
};

// Each function writes to `path`, which may not be the run itself and is replaced only with
// `overwrite`. `cell` is the same for all frames.

/// A pair of dumps as LAMMPS writes them (doc/src/dump.rst), blocks with ITEM: TIME and the frame's
/// step as TIMESTEP:
///   PATH            dump custom: id type mass radius x y z ix iy iz vx vy vz omegaz [fx fy fz],
///                   wrapped positions and periods to add; types from 1, the smallest species,
///                   the last one the boundary; for spheres also omegax and omegay
///   PATH.contacts   (before the ending) dump local: index batom1 batom2 dist, the normal force
///                   fx fy fz and the tangential force p1 p2 p3 on batom1, in the order of
///                   property/local and pair/local (OVITO knows batom1, batom2, dist by name); then
///                   forcex forcey, their sum to the last bit, branchx branchy (for spheres also
///                   forcez and branchz), overlap = -gap, and wall
/// A contact with a straight wall names its grain twice, since OVITO stops at a partner that is not
/// a grain, and has the number of the wall in `wall`, which is -1 otherwise. Reals have the fewest
/// digits that read back exactly.
std::unique_ptr<RunWriter> lammps_writer(const TrajectoryReader& run, const ViewCell& cell,
                                         const std::string& path, bool overwrite);

/// Extended XYZ as OVITO and ASE read it: per frame the number of grains that are present, a line
/// of keys, a row for each. Types are numbers (1 the smallest species, the
/// last one the boundary), since ASE refuses species that are not
/// chemical symbols. Reals have the fewest digits that read back exactly; discs have z = 0;
/// contacts cannot be stored.
std::unique_ptr<RunWriter> extxyz_writer(const TrajectoryReader& run, const ViewCell& cell,
                                         const std::string& path, bool overwrite);

/// H5MD 1.1 for MDAnalysis' H5MDReader, which refuses two dimensions: vectors of discs padded by z
/// = 0, the group /particles/trajectory, box/edges with one matrix per frame. The elements of
/// particles have no `unit`, as the reader does not know metres and refuses unknown units (and all
/// strings of fixed length, which H5MD demands); the file must be opened with convert_units=False,
/// and numbers are SI as stated by /h5md/modules/units. position, velocity, force (where the run
/// has it), image, angular_velocity (for discs about z, [F][N]); per grain id, species, radius,
/// mass. Grains that are absent in a frame are NaN in it, as H5MD has a fixed number of particles.
/// /observables are copied from the run. Contacts cannot be stored.
std::unique_ptr<RunWriter> h5md3d_writer(const TrajectoryReader& run, const ViewCell& cell,
                                         const std::string& path, bool overwrite);

/// A folder for ParaView: grains.pvd and contacts.pvd, each a list of times and files.
///   grains/      a vertex per grain that is present, with radius and diameter (to scale glyphs), mass,
///                species (0 the smallest, the last one the boundary), id, velocity,
///                angular_velocity (of discs about z), force
///   contacts/    a line per contact from x_i to x_i - branch, with points of its own: at the
///                periodic edge it leaves the cell instead of crossing the picture, and at a wall
///                it ends at the contact point. normal_force is given at points (for tubes) and at
///                lines, with force, tangential_force (of spheres its modulus), gap, pair_type (0 SS,
///                1 LS, 2 LL, 3 Sb, 4 Lb; where there are not two species instead species_i and
///                species_j, walls being of the boundary) and the ids i and j, -1 for wall 0, -2 for
///                wall 1
/// Reals are single precision.
std::unique_ptr<RunWriter> vtp_writer(const TrajectoryReader& run, const ViewCell& cell,
                                      const std::string& path, bool overwrite);

}  // namespace grseg
