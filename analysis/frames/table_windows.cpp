// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/table_windows.hpp"

#include "analysis/frames/layer_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>

namespace grseg {
namespace {

using Rows = std::vector<std::size_t>;

bool is_of_key(const std::string& name)
{
  return std::any_of(key_columns.begin(), key_columns.end(),
                     [&](const auto& key) { return name == key.name; });
}

/// Columns that both tables have beside the key, as pairs of their numbers.
std::vector<std::pair<std::size_t, std::size_t>> common_columns(const Table& a, const Table& b)
{
  std::vector<std::pair<std::size_t, std::size_t>> columns;
  for (std::size_t column = 0; column < a.columns.size(); ++column) {
    const auto name = without_unit(a.columns[column]);
    if (!is_of_key(name) && b.has_column(name)) columns.emplace_back(column, b.column(name));
  }
  return columns;
}

std::string unit_of(const std::string& column)
{
  return column.substr(std::min(column.find('['), column.size()));
}

/// True where both rows agree in the columns of one unit, up to a part of the largest number among them.
bool agree(const std::vector<double>& a, const std::vector<double>& b,
           const std::vector<std::pair<std::size_t, std::size_t>>& columns)
{
  constexpr double part = 1e-6;
  double scale = 0, largest = 0;
  for (const auto& [x, y] : columns) {
    scale = std::max({scale, std::abs(a[x]), std::abs(b[y])});
    largest = std::max(largest, std::abs(a[x] - b[y]));
  }
  return largest <= part * scale;
}

}  // namespace

double round_off_of(const Span& window)
{
  return 1e-6 * (window.second - window.first);
}

bool overlap(const Span& a, const Span& b)
{
  const double common = std::min(a.second, b.second) - std::max(a.first, b.first);
  return common > std::min(round_off_of(a), round_off_of(b));
}

TableWindows windows_of(const Table& table)
{
  TableWindows windows{&table, {}};
  const auto keys = read_layer_keys(table, "tables by layer and window have it");
  for (std::size_t row = 0; row < keys.size(); ++row)
    windows.rows[{keys[row].begin, keys[row].end}].push_back(row);
  return windows;
}

bool same_bits(const Table& a, const Rows& rows_a, const Table& b, const Rows& rows_b)
{
  if (rows_a.size() != rows_b.size()) return false;
  std::size_t numbers = 0;
  for (const auto& [x, y] : common_columns(a, b))
    for (std::size_t k = 0; k < rows_a.size(); ++k) {
      const double value = a.rows[rows_a[k]][x], other = b.rows[rows_b[k]][y];
      if (std::bit_cast<std::uint64_t>(value) != std::bit_cast<std::uint64_t>(other)) return false;
      if (value != 0 && value == value) ++numbers;
    }
  return numbers > 2;  // the two areas may be the same in layers that bear no stress
}

bool nothing_moved(const Table& a, const Rows& rows_a, const Table& b, const Rows& rows_b)
{
  if (rows_a.size() != rows_b.size()) return false;
  std::map<std::string, std::vector<std::pair<std::size_t, std::size_t>>> of_unit;
  for (const auto& columns : common_columns(a, b)) {
    const auto unit = unit_of(a.columns[columns.first]);
    if (unit == "[N m]" || unit == "[m^2]" || unit == "[m^3]") of_unit[unit].push_back(columns);
  }
  if (of_unit.empty()) return false;
  for (std::size_t k = 0; k < rows_a.size(); ++k)
    for (const auto& [unit, columns] : of_unit)
      if (!agree(a.rows[rows_a[k]], b.rows[rows_b[k]], columns)) return false;
  return true;
}

WindowLine put_in_line(const std::vector<TableWindow>& windows)
{
  std::vector<std::size_t> order(windows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return windows[a].span < windows[b].span; });
  std::map<const Table*, TableWindows> rows;
  for (const auto& window : windows)
    if (!rows.contains(window.table)) rows.emplace(window.table, windows_of(*window.table));
  const auto rows_of = [&](const TableWindow& window) -> const Rows& {
    return rows.at(window.table).rows.at(window.span);
  };

  WindowLine line{Rows(windows.size()), 0, 0};
  const TableWindow* last = nullptr;  // that began an observation
  for (const auto k : order) {
    const auto& window = windows[k];
    const bool again = last != nullptr && overlap(last->span, window.span);
    const bool still = last != nullptr && !again &&
                       nothing_moved(*last->table, rows_of(*last), *window.table, rows_of(window));
    line.still += still;
    if (!again && !still) {
      ++line.count;
      last = &window;
    }
    line.number[k] = line.count - 1;
  }
  return line;
}

}  // namespace grseg
