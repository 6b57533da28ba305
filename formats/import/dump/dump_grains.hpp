// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/dump/dump_pair.hpp"

#include <array>
#include <vector>

namespace grseg {

/// Reads blocks of `dump custom` by the names of their columns, which are those of LAMMPS and
/// LIGGGHTS: id, type, mass, radius or diameter; x y z, or unwrapped xu yu zu, or xs ys zs in parts
/// of the cell; ix iy iz; vx vy vz; omegax omegay omegaz; fx fy fz. id and positions are required,
/// a missing component is 0 and said to be missing, other columns are ignored.
class DumpGrains {
 public:
  /// Reads the rows of the current block of `dump`, and `more` columns of them, by number.
  void read(JoinedDumps& dump, ArchiveGrains& grains, const std::vector<std::size_t>& more = {});
  /// The values of more[k] of these rows.
  const std::vector<double>& more(std::size_t k) const { return values_[wanted_.size() + k]; }

 private:
  enum class Positions { plain, scaled };
  using Triple = std::array<int, 3>;  // places in wanted_, -1: the column is missing
  void look_up(const DumpHeader& header);
  int want(const DumpHeader& header, std::string_view name);
  Triple want(const DumpHeader& header, const std::array<const char*, 3>& names);
  void want_positions(const DumpHeader& header);
  void want_images(const DumpHeader& header);
  void take(const Triple& columns, std::vector<Vec3>& out) const;

  std::vector<std::string> names_;  // of the columns that the rest refers to
  std::vector<std::size_t> wanted_;
  int id_ = -1, type_ = -1, mass_ = -1, radius_ = -1, diameter_ = -1;
  Triple position_{}, image_{}, velocity_{}, spin_{}, force_{};
  Positions positions_ = Positions::plain;
  bool unwrapped_ = false;
  std::vector<std::string> missing_;  // components
  TypeNames types_;
  std::vector<std::vector<double>> values_;
};

}  // namespace grseg
