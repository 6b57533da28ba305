// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/layer_key.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {

std::vector<std::string> with_key_columns(const std::vector<std::string>& more)
{
  std::vector<std::string> names;
  names.reserve(key_columns.size() + more.size());
  for (const auto& column : key_columns) names.push_back(std::string(column.name) + column.unit);
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

std::vector<double> with_key(const LayerKey& key, const std::vector<double>& more)
{
  std::vector<double> row;
  row.reserve(key_columns.size() + more.size());
  for (const auto& column : key_columns) row.push_back(key.*column.value);
  row.insert(row.end(), more.begin(), more.end());
  return row;
}

LayerKeyReader::LayerKeyReader(const Table& table, const std::string& remedy) : table_(table)
{
  for (std::size_t c = 0; c < columns_.size(); ++c)
    columns_[c] = find_column(table, key_columns[c].name, remedy);
}

LayerKey LayerKeyReader::read(std::size_t row) const
{
  LayerKey key;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const auto value = key_columns[c].value;
    const bool is_height = value == &LayerKey::bottom || value == &LayerKey::top;
    key.*value = is_height && std::isnan(table_.rows[row][columns_[c]])
                     ? table_.rows[row][columns_[c]]
                     : finite_cell(table_, row, columns_[c]);
  }
  return key;
}

std::size_t find_column(const Table& table, const std::string& name, const std::string& remedy)
{
  if (!table.has_column(name))
    throw FormatError(fmt::format("{}: no column '{}'; {}", table.name, name, remedy));
  return table.column(name);
}

double finite_cell(const Table& table, std::size_t row, std::size_t column)
{
  const double value = table.rows[row][column];
  if (!std::isfinite(value))
    throw FormatError(fmt::format("{}: row {}, column {}: {} is not a finite number", table.name,
                                  row + 1, table.columns[column], format_number(value)));
  return value;
}

bool RowRange::holds_window(const LayerKey& key) const
{
  const double slack = 1e-9 * (1 + std::abs(key.begin) + std::abs(key.end));
  return !(key.begin < begin - slack) && !(key.end > end + slack);
}

}  // namespace grseg
