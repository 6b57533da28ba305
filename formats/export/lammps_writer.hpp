// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/export/output_file.hpp"
#include "formats/export/view_cell.hpp"
#include "formats/trajectory/reader.hpp"

#include <string>

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

}  // namespace grseg
