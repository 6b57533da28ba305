// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/dump/column_map.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// Which column of a contact row means what: "i=2,j=3,dist=4,force=5,tangential=8". Columns are
/// given by number, from 1, or by name. The meanings:
///   i, j          ids of the grains
///   force         force ON i FROM j, all of it or its normal part: three columns from this one on
///   tangential    tangential force ON i FROM j, three columns, to be added to it
///   fx fy fz, tx ty tz   single components, where there are fewer or other columns
///   dist          distance of the centres; or
///   overlap       how deep the two overlap, positive
///   bx by bz      branch x_i - x_j, else found from the positions; at a wall x_i - contact point
///   wall          number of the straight wall, negative where j is a grain; needs the branch
class ContactColumns {
 public:
  /// The text of --columns. UsageError unless it names i, j and a force.
  explicit ContactColumns(const std::string& text);

  /// Finds the columns among `names`. UsageError naming `place` where one is not there.
  void look_up(const std::vector<std::string>& names, const std::string& place)
  {
    map_.look_up(names, place);
  }
  /// The columns to read, 0-based, in the order in which `fill` takes them.
  const std::vector<std::size_t>& wanted() const { return map_.wanted(); }
  /// Rows as contacts; `values[k]` is column `wanted()[k]`. FormatError naming `place` where i or j
  /// is not an id.
  void fill(const std::vector<std::vector<double>>& values, const std::string& place,
            ArchiveContacts& contacts) const;

  const std::string& text() const { return map_.text(); }

 private:
  enum Meaning { i, j, fx, fy, fz, tx, ty, tz, bx, by, bz, dist, overlap, wall };

  void require_sense() const;
  bool has(std::size_t meaning) const { return map_.has(meaning); }

  ColumnMap map_;
};

}  // namespace grseg
