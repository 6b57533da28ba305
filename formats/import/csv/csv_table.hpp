// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/text_source.hpp"
#include "formats/import/csv/csv_files.hpp"
#include "formats/import/csv/csv_line.hpp"
#include "formats/import/csv/csv_map.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grseg {

/// When the rows of a moment are: a time, or where the table has none, a step.
struct CsvMoment {
  double value = 0;
  bool is_step = false;
};

/// A plain table in one file or many, each beginning with a line of column names (or, behind the
/// first, going on without one), then rows: separated by commas, semicolons, tabs or blanks
/// (csv_line.hpp), with a byte-order mark or none, lines ending as in Windows or not. Empty lines and
/// lines that begin with #, % or // are skipped; those above the first names are kept. Only columns
/// that are asked for must be numbers.
///
/// Rows are read in blocks of equal time, or of equal step; in a table that has neither column each
/// file is a block, whose name says when it is (csv_files.hpp).
class CsvTable {
 public:
  /// The names of a column, "x|posx", in lower case.
  struct Column {
    const char* names;
    bool needed;
    bool truth = false;  // "true" and "false" may stand for 1 and 0
  };

  /// `columns[0]` is the time, `columns[1]` the step; of each the table may have none. UsageError
  /// where a file is missing, FormatError naming the line where a required column is missing or
  /// present twice.
  CsvTable(std::vector<CsvFile> files, std::span<const Column> columns, CsvMap& map);

  bool has(std::size_t column) const { return place_[column] >= 0; }
  const std::vector<std::string>& comments() const { return comments_; }
  /// For a sentence: the names at hand.
  std::string names() const;
  [[noreturn]] void fail(const std::string& why) const;

  /// Reads the rows of the next moment; false at the end. FormatError naming the line where a row is
  /// damaged or of a moment before that of the row above.
  bool next();
  CsvMoment moment() const { return moment_; }
  std::size_t rows() const { return rows_; }
  /// 0 where the table has no such column.
  double value(std::size_t row, std::size_t column) const
  {
    return values_[row * columns_.size() + column];
  }
  /// "grains.csv, line 7": the first row of the moment.
  const std::string& begin() const { return begin_; }

 private:
  bool open_next();
  bool next_line();
  bool is_header() const;
  void read_names();
  void find_columns(const std::vector<std::string>& names);
  void require_a_moment() const;
  bool next_row();
  void read_fields();
  void wait_for_next_row();
  CsvMoment moment_of_row() const;

  std::vector<CsvFile> files_;
  std::size_t opened_ = 0;
  std::span<const Column> columns_;
  CsvMap& map_;
  std::optional<TextSource> source_;
  std::string_view line_;
  std::vector<std::string> comments_, header_;
  char separator_ = ' ';
  CsvNumbers numbers_;
  std::vector<int> place_;  // of the columns asked for; -1: missing
  std::vector<std::string_view> fields_;
  std::vector<double> row_, values_;  // of the columns asked for
  bool started_ = false;
  bool waiting_ = false;       // row_ is the first of the next moment
  bool ends_in_rows_ = false;  // files before this one have no line end behind their last row
  std::string begin_, waiting_place_;
  CsvMoment moment_;
  std::size_t rows_ = 0;
};

}  // namespace grseg
