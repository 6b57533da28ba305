// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/export/output_folder.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <string>

namespace grseg {

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
