// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grseg {

/// Tables that a tool reads, by the programs that made them.
struct WantedTables {
  std::vector<std::string_view> programs;  // "grseg-stress"; "": made by hand
  std::string remedy;                      // "name tables of grseg-stress, such as ..."
  std::string greedy = {};                 // option, "--minus", that takes all files behind it
};

/// A TSV table: "# key: value" lines, one line of column[unit] names, rows of numbers with 17
/// significant digits ("nan" for a missing value), and a last line with row count and checksum
/// (end_line()). The same content gives the same bytes.
class Table {
 public:
  /// Header lines (key, value) in order; a key may repeat, e.g. "history".
  std::vector<std::pair<std::string, std::string>> header;
  /// Column names with units as printed, e.g. "A_SS_xx[N m]".
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  /// Index of the column `name`, which is written without unit. Throws FormatError, which names the
  /// table, if there is no such column.
  std::size_t column(const std::string& name) const;
  bool has_column(const std::string& name) const;
  bool has_header(const std::string& key) const;
  /// First header value of `key`. Throws FormatError if there is none; header_number() also if it
  /// is not a number, header_positive() also if it is not a positive finite number.
  const std::string& header_text(const std::string& key) const;
  double header_number(const std::string& key) const;
  double header_positive(const std::string& key) const;
  /// True if no header line names a program: the table was made by hand.
  bool made_by_hand() const { return !has_header("program"); }

  std::string to_text() const;
  /// {"columns": [...], "rows": [[...], ...], "settings": {...}, "inputs": [...], "history":
  /// [...]}; NaN becomes null. If the header has such lines, also "bed", "verified", "incomplete",
  /// "undecided", "waived" and "doubt".
  std::string to_json() const;

  /// Reads a file, or standard input if `path` is "-". Throws UsageError if the file is missing.
  /// Throws FormatError, which names the line, if it is not a table or was changed: the last line
  /// must agree with all other lines. Only tables made by hand may lack it; their header then gets
  /// the line "verified: no, made by hand". Throws FormatError with the remedy if another program
  /// than those `wanted` made the table.
  static Table read(const std::string& path, const WantedTables* wanted = nullptr);
  static Table parse(const std::string& text, const std::string& name,
                     const WantedTables* wanted = nullptr);

  std::string name = "table";  // file name, for messages
};

/// Column name without its unit: "A_SS_xx" for "A_SS_xx[N m]".
std::string without_unit(const std::string& column);

// Functions that write tables.

/// Text of a table: "# key: value" lines, one line of column names, rows, and the last line.
/// Characters that are not printable are written as \xNN (text.hpp), so that no value can look like
/// another line.
std::string table_text(const std::vector<std::pair<std::string, std::string>>& header,
                       const std::vector<std::string>& columns,
                       const std::vector<std::vector<std::string>>& rows);

/// Lines above the rows: header lines and column names.
std::string table_head(const std::vector<std::pair<std::string, std::string>>& header,
                       const std::vector<std::string>& columns);
/// Appends the lines of `rows` to `text`.
void add_rows(std::string& text, const std::vector<std::vector<double>>& rows);

/// Beginning of the last line of a table.
inline constexpr std::string_view end_mark = "# end: ";

/// Last line of a table, "# end: 3 rows, xxh3 0123456789abcdef": the number of rows, and the xxh3
/// (64 bit) of all bytes before this line, which `head -n -1 table.tsv | xxhsum -H3` prints, too.
std::string end_line(std::string_view before, std::size_t rows);
std::string end_line(std::size_t rows, std::uint64_t digest_before);

/// Text of a number with 17 significant digits (as %.17g); "nan" for any NaN.
std::string format_number(double value);

}  // namespace grseg
