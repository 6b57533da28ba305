// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/dump/contact_columns.hpp"
#include "formats/import/dump/dump_grains.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Reads contacts with walls from the dump of grains: the eight columns f_NAME[1] to f_NAME[8] of
/// LAMMPS' `fix NAME all wall/gran ... contacts`. The first is 1 if the grain touches the wall;
/// then follow the force of the wall on the grain, the contact point, and the radius.
class WallColumns {
 public:
  /// `text` is "floor=f_floor[1],sides=27", with the first of the eight columns of each wall; or
  /// "none"; or "", to recognise walls by the names of their columns.
  explicit WallColumns(const std::string& text) : text_(text) {}

  /// Finds the columns of the walls. Throws UsageError if one is missing.
  void look_up(const DumpHeader& grains);
  /// Numbers, from 0, of the columns to read from the dump of grains: eight for each wall.
  const std::vector<std::size_t>& wanted() const { return wanted_; }
  /// Names of the walls, in order of their numbers.
  const std::vector<std::string>& walls() const { return walls_; }
  /// Adds the contacts, from the columns that `grains` has read as `more`. Throws FormatError if
  /// they do not contain flag, force, contact point and radius.
  void add_to(ArchiveFrame& frame, const DumpGrains& grains) const;

 private:
  std::string text_;
  std::vector<std::string> walls_;
  std::vector<std::size_t> wanted_;
};

/// Reads contacts with walls from a separate dump: LIGGGHTS' `compute wall/gran/local`. A mapping
/// names the columns: "id=9,force=10,point=1,centre=4,mesh=7,triangle=8".
///   id             id of the grain
///   force          force of the wall on the grain: first of three columns (or fx fy fz)
///   point          contact point: first of three columns (or px py pz)
///   centre         centre of the grain (or x y z); default: its position in the dump of grains
///   mesh triangle  numbers of mesh and triangle; the wall's number is a million times mesh plus
///                  triangle. Without them the rows of a grain are walls 0, 1, ...
class WallRows {
 public:
  explicit WallRows(const std::string& mapping);

  /// Adds the rows of the current block of `dump` to the contacts.
  void read(JoinedDumps& dump, ArchiveFrame& frame);

 private:
  ColumnMap map_;
  std::vector<std::vector<double>> values_;
};

}  // namespace grseg
