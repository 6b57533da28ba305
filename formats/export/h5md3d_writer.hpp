// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/output.hpp"
#include "formats/export/view_cell.hpp"
#include "formats/trajectory/reader.hpp"

#include <memory>
#include <string>
#include <vector>

namespace grseg {

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

}  // namespace grseg
