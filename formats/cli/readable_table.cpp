// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/readable_table.hpp"

#include "formats/cli/table.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace grseg {
namespace {

using Line = std::vector<std::string>;

std::string rounded(const std::string& cell, int digits)
{
  const auto number = parse_number(cell);
  const bool whole = cell.find_first_not_of("+-0123456789") == std::string::npos;
  return number && !whole ? fmt::format("{:.{}g}", *number, digits) : cell;
}

/// A table split into cells, with rounded numbers. The header lines stay one text; the last line of
/// the table (end_line()) is dropped.
struct Cells {
  std::string head;         // header lines "# key: value"
  std::vector<Line> lines;  // cells of each line; the first line has the column names

  Cells(std::string_view table, int digits)
  {
    std::istringstream text{std::string(table)};
    for (std::string line; std::getline(text, line);) {
      if (line.starts_with('#')) {
        if (lines.empty()) head += line + '\n';
        continue;
      }
      auto& cells = lines.emplace_back();
      std::istringstream words(line);
      for (std::string cell; std::getline(words, cell, '\t');)
        cells.push_back(lines.size() == 1 ? cell : rounded(cell, digits));
      if (line.ends_with('\t')) cells.emplace_back();
    }
  }
};

/// Removes the middle rows of a long table; returns the number of removed rows.
std::size_t shorten(std::vector<Line>& lines)
{
  constexpr std::ptrdiff_t at_each_end = 20;
  if (lines.size() <= 2 * at_each_end + 2) return 0;
  const auto left_out = lines.size() - 2 * at_each_end - 1;
  lines.erase(lines.begin() + 1 + at_each_end, lines.end() - at_each_end);
  lines.insert(lines.begin() + 1 + at_each_end, Line(lines.front().size(), "..."));
  return left_out;
}

/// Columns that tell rows apart: begin of window, layer or cell, and bin of forces.
constexpr std::string_view keys[] = {"t0", "r0", "x0", "y0", "z0"};

/// Columns that most readers look for in tables by layer; shown after the keys if not all columns fit.
constexpr std::string_view sought[] = {
    "phi_L",     "yL",     "height", "z_S",   "z_L",     "f_S",     "f_L",     "sliding_all",
    "a_c_all",   "n_SS",   "n_LS",   "n_LL",  "A_SS_yy", "A_LL_yy", "M_yy",    "u",
    "du_dy",     "K_S_yy", "K_L_yy", "T_S_y", "T_L_y",   "Sc_S_yy", "Sc_L_yy", "force_S_y",
    "force_L_y", "w_L",    "q_L",    "D_S",   "D_L",     "Pe"};

/// Removes all columns that are neither in `keys` nor in `sought`, unless fewer than five remain.
void choose_columns(std::vector<Line>& lines)
{
  std::vector<std::size_t> chosen;
  const auto& names = lines.front();
  for (std::size_t c = 0; c < names.size(); ++c)
    if (std::ranges::find(keys, without_unit(names[c])) != std::end(keys)) chosen.push_back(c);
  for (const auto name : sought)
    for (std::size_t c = 0; c < names.size(); ++c)
      if (without_unit(names[c]) == name) chosen.push_back(c);
  constexpr std::size_t enough = 5;
  if (chosen.size() < enough) return;
  for (auto& line : lines) {
    Line kept;
    for (const auto column : chosen) kept.push_back(line[column]);
    line = std::move(kept);
  }
}

/// Number of columns, from the left, that fit into readable_width; at least one.
std::size_t fitting(const std::vector<Line>& lines)
{
  std::size_t width = 0, column = 0;
  for (; column < lines.front().size(); ++column) {
    std::size_t widest = 0;
    for (const auto& line : lines) widest = std::max(widest, line[column].size());
    width += widest + (column > 0 ? 2 : 0);
    if (width > readable_width) break;
  }
  return std::max<std::size_t>(column, 1);
}

}  // namespace

std::string aligned(const std::vector<Line>& lines, const std::function<bool(std::size_t)>& left)
{
  std::vector<std::size_t> width(lines.front().size());
  for (const auto& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) width[c] = std::max(width[c], line[c].size());
  std::string text;
  for (const auto& line : lines) {
    for (std::size_t c = 0; c < line.size(); ++c) {
      const auto* gap = c > 0 ? "  " : "";
      text += left(c) ? fmt::format("{}{:<{}}", gap, line[c], width[c])
                      : fmt::format("{}{:>{}}", gap, line[c], width[c]);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

std::string readable_table(std::string_view table, int digits)
{
  auto lines = Cells(table, digits).lines;
  const auto columns = lines.front().size(), rows = lines.size() - 1;
  const auto rows_left_out = shorten(lines);
  for (auto& line : lines)
    for (auto& cell : line)
      if (cell == "nan" || cell.empty()) cell.assign(1, '-');
  if (fitting(lines) < columns) choose_columns(lines);
  const auto shown = fitting(lines);
  for (auto& line : lines) line.resize(shown);
  const auto is_word = [&lines](std::size_t c) {
    return std::any_of(lines.begin() + 1, lines.end(), [c](const Line& line) {
      return line[c] != "-" && line[c] != "..." && !parse_number(line[c]);
    });
  };
  auto text = aligned(lines, is_word);
  if (shown < columns || rows_left_out > 0)
    text += fmt::format("{} of {} columns and {} of {} rows; -o FILE has all\n", shown, columns,
                        rows - rows_left_out, rows);
  return text;
}

std::string rounded_table(std::string_view table, int digits)
{
  const Cells cells(table, digits);
  auto text = cells.head;
  for (const auto& line : cells.lines) text += fmt::format("{}\n", fmt::join(line, "\t"));
  return text + end_line(text, cells.lines.size() - 1) + '\n';
}

std::string wrapped(const std::string& sentence)
{
  std::string text;
  std::size_t column = 0;
  std::istringstream words(sentence);
  for (std::string word; words >> word; column += word.size()) {
    const bool breaks = column + 1 + word.size() > readable_width;
    const std::string_view gap = column == 0 ? "" : breaks ? "\n  " : " ";
    text.append(gap).append(word);
    column = breaks && column > 0 ? 2 : column + gap.size();
  }
  return text + '\n';
}

}  // namespace grseg
