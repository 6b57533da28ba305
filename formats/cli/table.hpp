// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grseg {

/// A TSV table: "# key: value" lines, one line of column[unit] names, rows of numbers with 17
/// significant digits ("nan" where there is no value), and a line that ends it (end_line).
/// The same content gives the same bytes.
class Table {
 public:
  /// In order; keys may repeat (history).
  std::vector<std::pair<std::string, std::string>> header;
  /// Names with units as printed, e.g. "A_SS_xx[N m]".
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  /// Column number of `name` given without its unit; FormatError naming the table where absent.
  std::size_t column(const std::string& name) const;
  bool has_column(const std::string& name) const;
  bool has_header(const std::string& key) const;
  /// First header value of `key`; FormatError where absent. `header_number` also where it is not a
  /// number, `header_positive` also where it is not a positive one.
  const std::string& header_text(const std::string& key) const;
  double header_number(const std::string& key) const;
  double header_positive(const std::string& key) const;
  /// A table that names no program was made by hand.
  bool made_by_hand() const { return !has_header("program"); }

  std::string to_text() const;
  /// {"columns": [...], "rows": [[...], ...], "settings": {...}, "inputs": [...], "history":
  /// [...]}; NaN becomes null. Where the header says so, also "bed", "verified", "incomplete",
  /// "undecided", "waived" and "doubt".
  std::string to_json() const;

  /// From a file, or from standard input where `path` is "-". UsageError where it is missing,
  /// FormatError, naming the line, where it is not a table or not as it was written: its last line
  /// must agree with all others, and may be missing only from tables made by hand, whose header
  /// then says so under "verified".
  static Table read(const std::string& path);
  static Table parse(const std::string& text, const std::string& name);

  std::string name = "table";  // where it came from, for messages
};

/// "A_SS_xx" of "A_SS_xx[N m]".
std::string without_unit(const std::string& column);

// How tables are written, all of them here.

/// "# key: value" lines, one line of column names, rows, and the line that ends the table. What is
/// not printable is shown as in text.hpp, so that no value can pass for another line.
std::string table_text(const std::vector<std::pair<std::string, std::string>>& header,
                       const std::vector<std::string>& columns,
                       const std::vector<std::vector<std::string>>& rows);

/// The lines above the rows.
std::string table_head(const std::vector<std::pair<std::string, std::string>>& header,
                       const std::vector<std::string>& columns);
/// The lines of rows, behind `text`.
void add_rows(std::string& text, const std::vector<std::vector<double>>& rows);

/// How the line that ends a table begins.
inline constexpr std::string_view end_mark = "# end: ";

/// "# end: 3 rows, xxh3 0123456789abcdef": the number of rows, and the xxh3 (64 bit) of all bytes
/// before this line, which `head -n -1 table.tsv | xxhsum -H3` prints, too.
std::string end_line(std::string_view before, std::size_t rows);
std::string end_line(std::size_t rows, std::uint64_t digest_before);

/// 17 significant digits, shortest of %g; "nan" for any NaN.
std::string format_number(double value);

}  // namespace grseg
