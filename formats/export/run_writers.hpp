// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/output.hpp"
#include "formats/export/output_file.hpp"
#include "formats/export/view_cell.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace grseg {

/// A pair of dumps as LAMMPS writes them (doc/src/dump.rst), blocks with ITEM: TIME and the frame's
/// step as TIMESTEP:
///   PATH            dump custom: id type mass radius x y z ix iy iz vx vy vz omegaz [fx fy fz],
///                   wrapped positions and periods to add, types from 1, the smallest species, to
///                   that of the boundary; of spheres also omegax and omegay
///   PATH.contacts   (before the ending) dump local: index batom1 batom2 dist, the normal force
///                   fx fy fz and the tangential force p1 p2 p3 on batom1, in the order of
///                   property/local and pair/local (OVITO knows batom1, batom2, dist by name); then
///                   forcex forcey, their sum to the last bit, branchx branchy (of spheres also forcez
///                   and branchz), overlap = -gap, and wall
/// A contact with a straight wall names its grain twice, since OVITO stops at a partner that is not
/// a grain, and has the number of the wall in `wall`, which is -1 otherwise. Reals have the fewest
/// digits that read back exactly.
class LammpsWriter {
 public:
  LammpsWriter(const TrajectoryReader& run, const ViewCell& cell, const std::string& path,
               bool overwrite);

  /// Needs velocities, images, contacts, and forces where the run has them.
  template <int D>
  void add(const Frame<D>& frame);
  void publish();

  /// The command that turns the dumps back into a run, with options for what dumps cannot hold.
  /// Valid when all frames have been added.
  std::string import_command() const;

 private:
  template <int D>
  std::string head(const Frame<D>& frame, const char* label, std::size_t rows) const;
  template <int D>
  void add_grains(const Frame<D>& frame);
  template <int D>
  void add_contacts(const Frame<D>& frame);

  const TrajectoryReader& run_;
  std::string bounds_, import_options_, grains_path_, contacts_path_;
  bool has_walls_ = false;
  OutputFile grains_file_, contacts_file_;
};

/// Extended XYZ as OVITO and ASE read it: per frame the number of grains that are present, a line
/// of keys, a row for each. Types are numbers (1 the smallest species, the
/// last one the boundary), since ASE refuses species that are not
/// chemical symbols. Reals have the fewest digits that read back exactly; discs have z = 0;
/// contacts cannot be stored.
class ExtxyzWriter {
 public:
  ExtxyzWriter(const TrajectoryReader& run, const ViewCell& cell, const std::string& path,
               bool overwrite);

  /// Needs velocities, and forces where the run has them.
  template <int D>
  void add(const Frame<D>& frame);
  void publish() { file_.publish(); }

 private:
  const Grains& grains_;
  std::vector<std::int32_t> species_;
  bool has_force_;
  std::string keys_;
  OutputFile file_;
};

/// H5MD 1.1 for MDAnalysis' H5MDReader, which refuses two dimensions: vectors of discs padded by
/// z = 0, the group /particles/trajectory, box/edges with one matrix per frame. The elements of
/// particles have no `unit`, as the reader does not know metres and refuses unknown units (and all
/// strings of fixed length, which H5MD demands); the file must be opened with convert_units=False,
/// and numbers are SI as stated by /h5md/modules/units. position, velocity, force (where the run
/// has it), image, angular_velocity (of discs about z, [F][N]), and per grain id, species, radius, mass;
/// Grains that are absent in a frame are NaN in it, as H5MD has a fixed number of particles.
/// /observables are those of the run. Contacts cannot be stored.
class H5md3dWriter {
 public:
  H5md3dWriter(const TrajectoryReader& run, const ViewCell& cell, const std::string& path,
               bool overwrite);
  ~H5md3dWriter();
  H5md3dWriter(H5md3dWriter&&) noexcept;

  /// Needs velocities, images, and forces where the run has them.
  template <int D>
  void add(const Frame<D>& frame);
  void publish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

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
class VtpWriter {
 public:
  VtpWriter(const TrajectoryReader& run, const std::string& folder, bool overwrite);

  /// Needs velocities, contacts, and forces where the run has them.
  template <int D>
  void add(const Frame<D>& frame);
  void publish();

 private:
  template <int D>
  std::string grains_text(const Frame<D>& frame) const;
  template <int D>
  std::string contacts_text(const Frame<D>& frame) const;

  const TrajectoryReader& run_;
  OutputFolder folder_;
  std::size_t frames_ = 0;
  std::string grains_list_, contacts_list_;
};

}  // namespace grseg
