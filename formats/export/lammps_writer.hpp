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
///                   wrapped positions and periods to add, type 1 small, 2 large, 3 boundary
///   PATH.contacts   (before the ending) dump local: index batom1 batom2 dist, the normal force
///                   fx fy fz and the tangential force p1 p2 p3 on batom1, in the order of
///                   property/local and pair/local (OVITO knows batom1, batom2, dist by name); then
///                   forcex forcey, their sum to the last bit, branchx branchy, overlap = -gap, and
///                   wall
/// A contact with a straight wall names its grain twice, since OVITO stops at a partner that is not
/// a grain, and has the number of the wall in `wall`, which is -1 otherwise. Reals have the fewest
/// digits that read back exactly.
class LammpsWriter {
 public:
  LammpsWriter(const TrajectoryReader& run, const ViewCell& cell, const std::string& path,
               bool overwrite);

  /// Needs velocities, images, contacts, and forces where the run has them.
  void add(const Frame<2>& frame);
  void publish();

  /// The command that turns the dumps back into a run, with options for what dumps cannot hold.
  /// Valid when all frames have been added.
  std::string import_command() const;

 private:
  std::string head(const Frame<2>& frame, const char* label, std::size_t rows) const;
  void add_grains(const Frame<2>& frame);
  void add_contacts(const Frame<2>& frame);

  const TrajectoryReader& run_;
  std::string bounds_, import_options_, grains_path_, contacts_path_;
  bool has_walls_ = false;
  OutputFile grains_file_, contacts_file_;
};

}  // namespace grseg
