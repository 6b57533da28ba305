// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/text_source.hpp"
#include "formats/import/common/text_values.hpp"
#include "formats/import/csv/csv_map.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// When the rows of a moment are: a time, or where the table has none, a step.
struct CsvMoment {
  double value = 0;
  bool is_step = false;
};

/// One file of a table, and the moment that its name states: what stands for `*` is a time if it is
/// a number with a decimal point, and otherwise ends in the digits of a step.
struct CsvFile {
  std::string path;
  std::optional<CsvMoment> moment;
};

/// The files that `names` stand for (archive_files.hpp), in natural order. In names without `*` (which a
/// shell may have replaced) the digits are the last ones before the ending.
std::vector<CsvFile> csv_files(const std::vector<std::string>& names, const std::string& option);

/// The separator of a table's columns: the first of comma, semicolon and tab in the line of its
/// names, outside quotation marks, or blanks.
char csv_separator(std::string_view names);

/// The fields of a line. A field in quotation marks may hold separators; the marks and the blanks
/// around a field go. They are views into `line`.
void split_csv(std::string_view line, char separator, std::vector<std::string_view>& fields);

/// Numbers as C or Fortran writes them (text_values.hpp), with a point or, where commas do not separate
/// columns, with a comma, the same in the whole table.
class CsvNumbers {
 public:
  explicit CsvNumbers(char separator = ' ') : may_have_comma_(separator != ',') {}

  /// False where `field` is not a finite number, or has the other decimal sign than those before.
  bool read(std::string_view field, double& number);
  /// A reason why the field is not read, to be added to a sentence; may be "".
  const char* why_not(std::string_view field) const;

 private:
  bool may_have_comma_;
  char sign_ = 0;  // of decimals; 0: not known yet
};

/// A plain table in one file or many, each beginning with a line of column names (or, behind the
/// first, going on without one), then rows: separated by commas, semicolons, tabs or blanks,
/// with a byte-order mark or none, lines ending as in Windows or not. Names may stand
/// in the comment above the rows, and where there are none --map names columns by number. Empty lines
/// and lines that begin with #, % or // are skipped; those above the first names are kept. Only columns
/// that are asked for must be numbers.
///
/// Rows are read in blocks of equal time, or of equal step; in a table that has neither column each
/// file is a block, whose name says when it is.
class CsvTable {
 public:
  /// The names of a column, "x|posx", in lower case.
  struct Column {
    const char* names;
    bool needed = false;
    enum Holds {
      numbers,
      truth,  // "true" and "false" may stand for 1 and 0
      words,  // words may stand for numbers (text_values.hpp)
      ids,    // --map may take the number of the row for it
    } holds = numbers;
  };

  /// `columns[0]` is the time, `columns[1]` the step; of each the table may have none. UsageError
  /// where a file is missing, FormatError naming the line where a required column is missing or
  /// present twice.
  CsvTable(std::vector<CsvFile> files, std::span<const Column> columns, CsvMap& map);

  bool has(std::size_t column) const { return place_[column] >= 0; }
  /// The meaning of the words in a column of words.
  TypeNames& words() { return words_; }
  const std::vector<std::string>& comments() const { return comments_; }
  /// For a sentence: the names at hand.
  std::string names() const;
  [[noreturn]] void fail(const std::string& why) const;

  /// Reads the rows of the next moment; false at the end. FormatError naming the line where a row
  /// is damaged, or of an earlier moment than the row above.
  bool next();
  CsvMoment moment() const { return moment_; }
  /// To the next moment; 0 at the end.
  double interval() const { return waiting_ ? moment_of_row().value - moment_.value : 0; }
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
  bool is_row_of_numbers();
  void name_columns();
  bool take_names_of_comment();
  void read_names();
  void find_columns(const std::vector<std::string>& names);
  void require_a_moment() const;
  bool go_to_row();
  bool next_row();
  void read_fields();
  void read_word(std::size_t column, std::string_view field);
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
  bool row_waits_ = false;  // it is the line at hand, which should have been names
  TypeNames words_;
  std::vector<int> place_;                 // of the columns asked for; -1: missing
  std::optional<std::int64_t> first_row_;  // where the numbers of rows stand for a column
  std::size_t row_column_ = 0;             // this one
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
