// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/dump/dump_pair.hpp"

#include <vector>

namespace grseg {

/// The columns of a dump that DumpGrains does not read, and which may say something of
/// shape, place or force. LAMMPS's other attributes of atoms, and numbers of computes, fixes and
/// variables, do not.
std::vector<std::string> unknown_columns(const DumpHeader& grains);

/// Reads blocks of `dump custom` by the column names of LAMMPS and LIGGGHTS: id, type, mass, radius
/// or diameter; x y z, or unwrapped xu yu zu, or xs ys zs as fractions of the cell; ix iy iz; vx vy
/// vz; omegax omegay omegaz; fx fy fz. Id and positions are required. A missing component is 0 and
/// listed in `missing`.
class DumpGrains {
 public:
  /// Reads the grains of the current block of `dump` into `grains`, and beside them the columns `more` of the dump
  /// (0 is the first).
  void read(JoinedDumps& dump, ArchiveGrains& grains, const std::vector<std::size_t>& more = {});
  /// The values of column more[k] in these rows.
  const std::vector<double>& more(std::size_t k) const { return values_[own_ + k]; }

 private:
  TypeNames types_;
  std::vector<std::vector<double>> values_;
  std::size_t own_ = 0;  // number of columns in values_ that precede `more`
};

}  // namespace grseg
