// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace grseg {

/// One number of a table's row with the name and unit of its column, "f_S[N]". Tables list their
/// cells once and take both the line of column names and the rows from that list.
struct Cell {
  std::string column;
  double value;
};

inline std::vector<std::string> columns_of(const std::vector<Cell>& cells)
{
  std::vector<std::string> columns;
  columns.reserve(cells.size());
  for (const auto& cell : cells) columns.push_back(cell.column);
  return columns;
}

inline std::vector<double> values_of(const std::vector<Cell>& cells)
{
  std::vector<double> values;
  values.reserve(cells.size());
  for (const auto& cell : cells) values.push_back(cell.value);
  return values;
}

}  // namespace grseg
