// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/table_text.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// A TSV table: "# key: value" lines, one line of column[unit] names, rows of numbers with 17
/// significant digits ("nan" where there is no value), and a line that ends it (table_text.hpp).
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
  /// must agree with all others, and may be missing only from tables made by hand or by versions
  /// that wrote none. The header of these then says so under "verified".
  static Table read(const std::string& path);
  static Table parse(const std::string& text, const std::string& name);

  std::string name = "table";         // where it came from, for messages
  std::string version_without_end{};  // of the grseg that wrote it, where that wrote no last line
};

/// "A_SS_xx" of "A_SS_xx[N m]".
std::string without_unit(const std::string& column);

}  // namespace grseg
