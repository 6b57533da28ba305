// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// Tables for reading, made of the text of whole ones (table.hpp).
namespace grseg {

inline constexpr std::size_t readable_width = 100;  // columns of letters

/// Lines of one length as text: what is `left` to the left, else to the right, columns as wide as they
/// must be.
std::string aligned(const std::vector<std::vector<std::string>>& lines,
                    const std::function<bool(std::size_t column)>& left);

/// Without the lines "# key: value": the columns that fit, of many those that most readers look for, the first and last of many rows,
/// numbers of `digits` significant digits; then a line that says what is left out.
std::string readable_table(std::string_view table, int digits);

/// The same table with numbers of so many digits; words and whole numbers stay as they are.
std::string rounded_table(std::string_view table, int digits);

}  // namespace grseg
