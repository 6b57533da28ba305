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

/// Lines of equally many cells as text, in columns as wide as their cells need: aligned to the left
/// where `left` is true, else to the right.
std::string aligned(const std::vector<std::vector<std::string>>& lines,
                    const std::function<bool(std::size_t column)>& left);

/// The table for a terminal, without its lines "# key: value": as many columns as fit, the most
/// sought ones first; the first and last rows where there are many; numbers of `digits` significant
/// digits. A last line says what is left out.
std::string readable_table(std::string_view table, int digits);

/// The whole table with numbers of `digits` significant digits; words and whole numbers stay as
/// they are.
std::string rounded_table(std::string_view table, int digits);

}  // namespace grseg
