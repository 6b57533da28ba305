// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/dump/dump_pair.hpp"

#include <vector>

namespace grseg {

/// Reads blocks of `dump custom` by the names that LAMMPS and LIGGGHTS give to their columns: id,
/// type, mass, radius or diameter; x y z, or unwrapped xu yu zu, or xs ys zs in parts of the cell;
/// ix iy iz; vx vy vz; omegax omegay omegaz; fx fy fz. id and positions are required, a missing
/// component is 0 and listed as missing, other columns are ignored.
class DumpGrains {
 public:
  /// Reads the rows of the current block of `dump`, and `more` columns of them, by number.
  void read(JoinedDumps& dump, ArchiveGrains& grains, const std::vector<std::size_t>& more = {});
  /// The values of more[k] of these rows.
  const std::vector<double>& more(std::size_t k) const { return values_[own_ + k]; }

 private:
  TypeNames types_;
  std::vector<std::vector<double>> values_;
  std::size_t own_ = 0;  // columns in front of `more`
};

}  // namespace grseg
