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

/// The time of a frame's rows, or their step if the table has no times.
struct CsvTime {
  double value = 0;
  bool is_step = false;
};

/// One file of a table, and the time or step in its name. The text in place of `*` is a time if it
/// is a number with a decimal point; otherwise its last digits are a step.
struct CsvFile {
  std::string path;
  std::optional<CsvTime> time;
};

/// The files that match `names` (archive_files.hpp), in natural order. In names without `*` (a
/// shell may have expanded it) the step is the last digits before the ending.
std::vector<CsvFile> csv_files(const std::vector<std::string>& names, const std::string& option);

/// The separator of a table's columns: comma, semicolon or tab, the first of these that the line of
/// column names contains outside quotation marks; otherwise a blank.
char csv_separator(std::string_view names);

/// Splits a line into fields, which are views into `line`. A field in quotation marks may contain
/// separators. Quotation marks and blanks around a field are removed.
void split_csv(std::string_view line, char separator, std::vector<std::string_view>& fields);

/// Reads numbers in the notation of C or Fortran (text_values.hpp). If commas do not separate
/// columns, the decimal sign may be a comma instead of a point, but the same in the whole table.
class CsvNumbers {
 public:
  explicit CsvNumbers(char separator = ' ') : may_have_comma_(separator != ',') {}

  /// Reads a number; false if it is not finite, or has another decimal sign than earlier numbers.
  bool read(std::string_view field, double& number);
  /// The reason why a field was refused, to be added to a message; may be "".
  const char* why_not(std::string_view field) const;

 private:
  bool may_have_comma_;
  char sign_ = 0;  // decimal sign, '.' or ','; 0: not known yet
};

/// Reads a plain table in one file or many. A file begins with a line of column names, optional
/// after the first file; rows follow. Columns are separated by commas, semicolons, tabs or blanks.
/// A byte-order mark and line ends of Windows are accepted. Names may also be in the comment above
/// the rows; without names, --map names columns by number. Empty lines and lines that begin with #,
/// % or // are skipped; comments() returns those above the first names. Only the required columns
/// must be numbers.
///
/// Rows of equal time or step form a frame. In a table without a column of times or steps each file
/// is a frame, and its name states the time or step.
class CsvTable {
 public:
  /// A column that a table may have. `names` lists its possible names in lower case: "x|posx".
  struct Column {
    const char* names;
    bool needed = false;
    enum Holds {
      numbers,
      truth,  // 1 and 0, or "true" and "false"
      words,  // numbers or words (TypeNames in text_values.hpp)
      ids,    // ids, which --map may set to the number of the row
    } holds = numbers;
  };

  /// Opens the table. `columns[0]` is the time, `columns[1]` the step; both are optional. Throws
  /// UsageError if a file is missing, FormatError naming the line if a column is present twice.
  /// Rows can be read only if missing() is empty.
  CsvTable(std::vector<CsvFile> files, std::span<const Column> columns, CsvMap& map);

  bool has(std::size_t column) const { return place_[column] >= 0; }
  /// The words of a column of words, and their codes.
  TypeNames& words() { return words_; }
  const std::vector<std::string>& comments() const { return comments_; }
  /// Names of the needed columns that the table lacks; a step counts as a time.
  const std::vector<std::string>& missing() const { return missing_; }
  /// A sentence about missing columns and how to name them; "" without any.
  std::string complaint(const std::vector<std::string>& missing) const;
  /// Names in the header of columns without a known meaning that --map does not leave out.
  const std::vector<std::string>& unused() const { return unused_; }
  /// The column names of the current file, in quotation marks, for a message.
  std::string names() const;
  [[noreturn]] void fail(const std::string& why) const;

  /// Reads the rows of the next frame; false at the end. Throws FormatError naming the line if a
  /// row is damaged, or has an earlier time than the row above.
  bool next();
  CsvTime time() const { return time_; }
  /// Time (or steps) from this frame to the next; 0 at the end.
  double interval() const { return waiting_ ? time_of_row().value - time_.value : 0; }
  std::size_t rows() const { return rows_; }
  /// Number in a row of this frame; 0 if the table does not have the column.
  double value(std::size_t row, std::size_t column) const
  {
    return values_[row * columns_.size() + column];
  }
  /// File and line of the frame's first row: "grains.csv, line 7".
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
  bool go_to_row();
  bool next_row();
  void read_fields();
  void read_word(std::size_t column, std::string_view field);
  void wait_for_next_row();
  CsvTime time_of_row() const;

  std::vector<CsvFile> files_;
  std::size_t opened_ = 0;
  std::span<const Column> columns_;
  CsvMap& map_;
  std::optional<TextSource> source_;
  std::string_view line_;
  std::vector<std::string> comments_, header_, missing_, unused_;
  char separator_ = ' ';
  CsvNumbers numbers_;
  bool row_waits_ = false;  // true: the current line, expected to have names, is a row to be read
  TypeNames words_;
  std::vector<int> place_;                 // index in the file, for each of columns_; -1: missing
  std::optional<std::int64_t> first_row_;  // number of a frame's first row, if rows replace ids
  std::size_t row_column_ = 0;             // index in columns_ of the column that rows replace
  std::vector<std::string_view> fields_;
  // Values by column: of the next row; of the rows of the frame, one after the other.
  std::vector<double> row_, values_;
  bool started_ = false;
  bool waiting_ = false;       // true: row_ is the first row of the next frame
  bool ends_in_rows_ = false;  // true: an earlier file has no line end behind its last row
  std::string begin_, waiting_place_;
  CsvTime time_;
  std::size_t rows_ = 0;
};

}  // namespace grseg
