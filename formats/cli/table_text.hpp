// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// How tables are written, all of them here.
namespace grseg {

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
std::vector<std::string> format_numbers(const std::vector<double>& values);

}  // namespace grseg
