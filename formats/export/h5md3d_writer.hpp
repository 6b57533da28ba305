// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/export/output.hpp"
#include "formats/export/view_cell.hpp"
#include "formats/trajectory/reader.hpp"

#include <memory>
#include <string>
#include <vector>

namespace grseg {

/// H5MD 1.1 as MDAnalysis' H5MDReader wants it, which refuses two dimensions: vectors padded by
/// z = 0, the group /particles/trajectory, box/edges with one matrix per frame. No `unit` stands at
/// particles' elements, as the reader knows no metre and refuses what it does not know (and every
/// string of fixed length, which H5MD asks for); it has to be opened with convert_units=False, and
/// numbers are SI as /h5md/modules/units says.
/// position, velocity, force (where the run has it), image, angular_velocity (about z, [F][N]), and
/// per grain id, species, radius, mass; /observables are those of the run. Contacts have no place
/// in it.
class H5md3dWriter {
 public:
  H5md3dWriter(const TrajectoryReader& run, const ViewCell& cell, const std::string& path,
               bool overwrite);
  ~H5md3dWriter();
  H5md3dWriter(H5md3dWriter&&) noexcept;

  /// Needs velocities, images, and forces where the run has them.
  void add(const Frame& frame);
  void publish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grseg
