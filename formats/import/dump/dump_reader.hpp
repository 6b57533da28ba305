// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/common/text_source.hpp"
#include "formats/import/common/text_values.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// The lines above the rows of one block of a text dump.
struct DumpHeader {
  std::int64_t step = 0;
  std::optional<double> time;
  std::size_t rows = 0;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  std::array<bool, 3> periodic{};
  std::array<bool, 3> shrinks{};     // the bounds follow the grains (boundary s or m)
  std::string label;                 // of the rows: ATOMS, ENTRIES
  std::vector<std::string> columns;  // names
  std::string file, place;           // "atoms.dump", "atoms.dump, line 1"

  /// 0-based, of the column of this name.
  std::optional<std::size_t> find(std::string_view name) const;
};

/// A column of types, whose words stand for numbers.
struct TypeColumn {
  int place = -1;  // among the wanted columns; -1: there is none
  TypeNames* names = nullptr;
};

/// The blocks of text dumps (`dump custom`, `dump local`) of LAMMPS and LIGGGHTS, by the grammar of
/// LAMMPS' doc/src/dump.rst:
///   [ITEM: UNITS] [ITEM: TIME] ITEM: TIMESTEP, ITEM: NUMBER OF label, ITEM: BOX BOUNDS,
///   ITEM: label names of columns, rows,
/// label being ATOMS, ENTRIES or what `dump_modify label` makes of it.
/// FormatError naming file, line and remedy where a block is damaged, TruncatedArchive where the
/// archive ends in it or where the block of the next job begins.
class DumpReader {
 public:
  explicit DumpReader(std::vector<std::string> files) : source_(std::move(files)) {}
  /// Reads files that hold nothing but rows of the block with this header, all of which can be
  /// read.
  DumpReader(std::vector<std::string> files, DumpHeader header)
      : source_(std::move(files)), header_(std::move(header)), has_rows_alone_(true)
  {
  }

  /// Advances to the next block, skipping rows that were not read; false at the end.
  bool next();
  const DumpHeader& header() const { return header_; }
  /// From ITEM: UNITS, which only the first block has.
  const std::optional<std::string>& units() const { return units_; }

  /// Reads the rows of the block: column `wanted[k]` of all rows is added to values[k]. Other columns
  /// are counted but not parsed.
  void read_rows(std::span<const std::size_t> wanted, std::vector<std::vector<double>>& values,
                 const TypeColumn& types = {});

 private:
  std::string_view next_line(const char* what);
  void skip_rows();
  [[noreturn]] void fail_at_next_block(std::size_t begin);
  void require_line(bool there, const char* what);
  void read_header();
  void read_item(std::string_view item, std::string& label);
  void read_box(std::string_view item);
  void read_general_box(std::string_view item);
  [[noreturn]] void refuse_tilted_cell() const;
  void read_row(std::span<const int> role, std::vector<std::vector<double>>& values,
                const TypeColumn& types);
  double number_in(std::string_view word, std::size_t column, TypeNames* names);

  TextSource source_;
  DumpHeader header_;
  std::optional<std::string> units_;
  std::size_t rows_left_ = 0;
  // Where the first line of the next block begins in the line that the source stands at.
  std::optional<std::size_t> next_block_;
  bool has_rows_alone_ = false;
};

}  // namespace grseg
