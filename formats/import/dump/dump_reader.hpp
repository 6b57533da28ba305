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

/// The header of one block (frame) of a text dump: the lines above its rows.
struct DumpHeader {
  std::int64_t step = 0;
  std::optional<double> time;
  std::size_t rows = 0;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  std::array<bool, 3> periodic{};
  std::array<bool, 3> shrinks{};     // true: the bounds are fitted to the grains (boundary s or m)
  std::string label;                 // label of the rows: ATOMS, ENTRIES
  std::vector<std::string> columns;  // names of the columns
  std::string file, place;           // file, and its line: "atoms.dump", "atoms.dump, line 1"

  /// Number, from 0, of the column of this name; empty if there is none.
  std::optional<std::size_t> find(std::string_view name) const;
};

/// The column of types, which may contain words (TypeNames).
struct TypeColumn {
  int place = -1;  // index among the wanted columns; -1: there is no such column
  TypeNames* names = nullptr;
};

/// Reads the blocks of text dumps (`dump custom`, `dump local`) of LAMMPS and LIGGGHTS, by the
/// grammar of LAMMPS' doc/src/dump.rst:
///   [ITEM: UNITS] [ITEM: TIME] ITEM: TIMESTEP, ITEM: NUMBER OF label, ITEM: BOX BOUNDS,
///   ITEM: label names of columns, rows,
/// where label is ATOMS, ENTRIES or the label set by `dump_modify label`. Throws FormatError naming
/// file, line and remedy if a block is damaged, TruncatedArchive if the archive ends in the block,
/// or if the first block of the next job begins in it.
class DumpReader {
 public:
  explicit DumpReader(std::vector<std::string> files) : source_(std::move(files)) {}
  /// Reads files with nothing but rows of a block with this header; next() must not be called.
  DumpReader(std::vector<std::string> files, DumpHeader header)
      : source_(std::move(files)), header_(std::move(header)), has_rows_alone_(true)
  {
  }

  /// Advances to the next block, skipping rows that were not read; false at the end.
  bool next();
  const DumpHeader& header() const { return header_; }
  /// The units by ITEM: UNITS, which only the first block has.
  const std::optional<std::string>& units() const { return units_; }

  /// Reads the rows of the block and appends column `wanted[k]` of each row to values[k]. Other
  /// columns are skipped; a row must have as many columns as the header.
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
  // Position in the current line at which the next block begins; empty if none begins there.
  std::optional<std::size_t> next_block_;
  bool has_rows_alone_ = false;
};

}  // namespace grseg
