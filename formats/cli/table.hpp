// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// A TSV table: "# key: value" lines, one line of column[unit] names, rows of numbers with 17
/// significant digits ("nan" where there is no value). The same content gives the same bytes.
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
  /// First header value of `key`; FormatError where absent. `header_number` also where it is not a
  /// number.
  const std::string& header_text(const std::string& key) const;
  double header_number(const std::string& key) const;

  std::string to_text() const;
  /// {"columns": [...], "rows": [[...], ...], "settings": {...}, "inputs": [...], "history":
  /// [...]}; NaN becomes null.
  std::string to_json() const;

  /// From a file, or from standard input where `path` is "-". UsageError where it is missing,
  /// FormatError with the line number where it is not a table.
  static Table read(const std::string& path);
  static Table parse(const std::string& text, const std::string& name);

  std::string name = "table";  // where it came from, for messages
};

/// 17 significant digits, shortest of %g; "nan" for any NaN.
std::string format_number(double value);

}  // namespace grseg
