// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/dump/contact_columns.hpp"
#include "formats/import/dump/dump_grains.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Contacts with walls in the dump of grains: the eight columns f_NAME[1] to f_NAME[8] of LAMMPS'
/// `fix NAME all wall/gran ... contacts`. The first is 1 where the grain touches the wall, then
/// follow the force of the wall on the grain, the contact point, and the radius.
class WallColumns {
 public:
  /// `text`: "floor=f_floor[1],sides=27", the first of eight columns of each wall; "none"; or ""
  /// where walls are recognised by the names of their columns.
  explicit WallColumns(const std::string& text) : text_(text) {}

  /// UsageError where a column is not there.
  void look_up(const DumpHeader& grains);
  /// Columns of the dump of grains, 0-based, eight for each wall.
  const std::vector<std::size_t>& wanted() const { return wanted_; }
  /// Names of the walls, by number.
  const std::vector<std::string>& walls() const { return walls_; }
  /// Adds the contacts; `grains` has read these columns as `more`. FormatError where they do not hold
  /// what they should.
  void add_to(ArchiveMoment& moment, const DumpGrains& grains) const;

 private:
  std::string text_;
  std::vector<std::string> walls_;
  std::vector<std::size_t> wanted_;
};

/// Contacts with walls as rows of a dump of their own: LIGGGHTS' `compute wall/gran/local`. A mapping
/// gives their columns: "id=9,force=10,point=1,centre=4,mesh=7,triangle=8".
///   id             of the grain
///   force          of the wall on the grain, three columns from this one on (or fx fy fz)
///   point          where they touch, likewise (px py pz)
///   centre         of the grain there (x y z), else its position in the dump of grains
///   mesh triangle  number the walls: mesh times a million plus triangle; without them the rows of a
///                  grain are walls 0, 1, ...
class WallRows {
 public:
  explicit WallRows(const std::string& mapping);

  /// Adds the rows of the current block of `dump` to the contacts.
  void read(JoinedDumps& dump, ArchiveMoment& moment);

 private:
  ColumnMap map_;
  std::vector<std::vector<double>> values_;
};

}  // namespace grseg
