// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "formats/export/map_file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grseg {
namespace {

enum Key : std::size_t { begin, end, low_1, high_1, low_2, high_2, frames, volume, keys };

std::string unit_of(const std::string& column)
{
  const auto open = column.find('[');
  if (open == std::string::npos) return {};
  return column.substr(open + 1, column.size() - open - 2);
}

/// Name of the axis whose cell edges are in columns `low` and `low` + 1: "x" for "x0[m]", "x1[m]".
/// Throws FormatError for other column names.
std::string axis_of(const Table& table, Key low)
{
  const auto &first = table.columns[low], &second = table.columns[low + 1];
  std::string name = first.substr(0, 1);
  if (first != name + "0[m]" || second != name + "1[m]")
    throw FormatError(
        fmt::format("{}: not the table of a map: columns {} and {} should be the edges of "
                    "cells; make the table with --bins xy",
                    table.name, first, second));
  return name;
}

/// Edges of the cells along one axis (m). Neighbouring cells are `stride` rows apart; the axis ends
/// where a cell does not begin at the end of the cell before.
std::vector<double> edges_of(const Table& table, Key low, std::size_t stride)
{
  const auto& rows = table.rows;
  std::vector<double> edges{rows[0][low]};
  for (std::size_t row = 0; row < rows.size() && rows[row][low] == edges.back(); row += stride)
    edges.push_back(rows[row][low + 1]);
  return edges;
}

void require_grid(const Table& table, const MapTable& map)
{
  const auto& [first, second] = map.axes;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto& cells = table.rows[row];
    const std::size_t i = row % first.cells(), j = row % map.cells() / first.cells();
    const auto& start = table.rows[row - row % map.cells()];
    if (cells[low_1] != first.edges[i] || cells[low_2] != second.edges[j] ||
        cells[begin] != start[begin] || cells[end] != start[end] || cells[frames] != start[frames])
      throw FormatError(fmt::format("{}: row {} is not the next cell of a grid of {} by {} cells",
                                    table.name, row + 1, first.cells(), second.cells()));
  }
  if (table.rows.size() % map.cells() != 0)
    throw FormatError(fmt::format("{}: the last window has too few cells", table.name));
}

MapTable::Field field_of(const Table& table, std::size_t column, std::size_t rows)
{
  MapTable::Field field{without_unit(table.columns[column]), unit_of(table.columns[column]), {}};
  field.values.reserve(rows);
  for (std::size_t row = 0; row < rows; ++row) field.values.push_back(table.rows[row][column]);
  return field;
}

}  // namespace

std::vector<std::string> map_key_columns(const std::array<std::string, 2>& axes, int dimension)
{
  return {
      "t0[s]",          "t1[s]",          axes[0] + "0[m]", axes[0] + "1[m]",
      axes[1] + "0[m]", axes[1] + "1[m]", "frames",         dimension == 3 ? "V[m^3]" : "V[m^2]"};
}

MapTable map_table(const Table& table)
{
  if (table.columns.size() < keys || table.rows.empty())
    throw FormatError(table.name + ": not the table of a map; make a map with --bins xy");
  MapTable map;
  map.axes[0] = {axis_of(table, low_1), edges_of(table, low_1, 1)};
  map.axes[1] = {axis_of(table, low_2), edges_of(table, low_2, map.axes[0].cells())};
  require_grid(table, map);
  for (std::size_t row = 0; row < table.rows.size(); row += map.cells())
    map.windows.push_back({table.rows[row][begin], table.rows[row][end], table.rows[row][frames]});
  map.volume = field_of(table, volume, map.cells());
  for (std::size_t column = keys; column < table.columns.size(); ++column)
    map.fields.push_back(field_of(table, column, table.rows.size()));
  for (const auto& [key, value] : table.header) {
    const auto known = std::find_if(map.header.begin(), map.header.end(),
                                    [&, &k = key](const auto& line) { return line.first == k; });
    if (known == map.header.end())
      map.header.emplace_back(key, value);
    else
      known->second += '\n' + value;
  }
  return map;
}

}  // namespace grseg
