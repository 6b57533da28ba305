// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// Short tables for people to read, made from the text of whole tables (table.hpp).
namespace grseg {

inline constexpr std::size_t readable_width = 100;  // width of a short table, characters

/// Text of `lines`, which all have the same number of cells, with each column as wide as its widest
/// cell. Columns for which `left` is true are aligned to the left, others to the right.
std::string aligned(const std::vector<std::vector<std::string>>& lines,
                    const std::function<bool(std::size_t column)>& left);

/// Short table for a terminal, without the lines "# key: value" and with `digits` significant
/// digits. If the columns do not all fit, the most useful ones come first; of many rows only the
/// first and last ones are shown. A last line reports how many columns and rows are left out.
std::string readable_table(std::string_view table, int digits);

/// The whole table with numbers rounded to `digits` significant digits; words and whole numbers
/// stay unchanged.
std::string rounded_table(std::string_view table, int digits);

/// The sentence in lines of at most `readable_width` columns; later lines are indented.
std::string wrapped(const std::string& sentence);

}  // namespace grseg
