// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/text_source.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grseg {

/// The names of columns in a table's first line: in lower case, without quotation marks and units.
std::vector<std::string> names_in_header(std::string_view line);

/// A plain table: one line of column names, then rows, separated by commas, semicolons, tabs or
/// blanks, whichever of these, in this order, the line of names contains. Empty lines and lines
/// that begin with # are skipped; those above the names are kept. Rows are read in blocks of equal
/// time.
class CsvTable {
 public:
  /// The names of a column, "x|posx", in lower case; a unit in [] after the name in the table is
  /// ignored.
  struct Column {
    const char* names;
    bool needed;
  };

  /// `columns[0]` is the time. UsageError where a file is missing, FormatError naming the line
  /// where a required column is missing or present twice.
  CsvTable(std::vector<std::string> files, std::span<const Column> columns);

  bool has(std::size_t column) const { return place_[column] >= 0; }
  const std::vector<std::string>& comments() const { return comments_; }

  /// Reads the rows of the next time; false at the end. FormatError naming the line where a row is
  /// damaged or of a time before that of the row above.
  bool next();
  double time() const { return time_; }
  std::size_t rows() const { return rows_; }
  /// 0 where the table has no such column.
  double value(std::size_t row, std::size_t column) const;
  /// "grains.csv, line 7": the first row of the time.
  const std::string& begin() const { return begin_; }

 private:
  void read_names(std::span<const Column> columns);
  bool next_row();
  [[noreturn]] void fail(const std::string& why) const;

  TextSource source_;
  std::vector<std::string> comments_;
  char separator_ = ' ';
  std::size_t width_ = 0;
  std::vector<int> place_;  // of the columns asked for; -1: missing
  std::vector<double> row_, values_;
  bool waiting_ = false;  // row_ is the first of the next time
  std::string begin_, waiting_place_;
  double time_ = 0;
  std::size_t rows_ = 0;
};

}  // namespace grseg
