// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/text_source.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grseg {

/// A plain table: one line of column names, then rows, set apart by commas, semicolons, tabs or
/// blanks, whichever comes first in this order in the line of names. Lines that begin with # and
/// empty ones are passed over, those above the names are kept. Rows are taken in blocks of equal
/// time.
class CsvTable {
 public:
  /// A column by the names that it goes by, "x|posx", in lower case; a unit in [] behind the name
  /// in the table is passed over.
  struct Column {
    const char* names;
    bool needed;
  };

  /// `columns[0]` is the time. UsageError where a file is missing, FormatError naming the line
  /// where a needed column is not there or two go by names of one.
  CsvTable(std::vector<std::string> files, std::span<const Column> columns);

  bool has(std::size_t column) const { return place_[column] >= 0; }
  const std::vector<std::string>& comments() const { return comments_; }

  /// Takes the rows of the next time; false at the end. FormatError naming the line where a row is
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
  std::vector<int> place_;  // of the columns asked for; -1: not there
  std::vector<double> row_, values_;
  bool waiting_ = false;  // row_ is the first of the next time
  std::string begin_, waiting_place_;
  double time_ = 0;
  std::size_t rows_ = 0;
};

}  // namespace grseg
