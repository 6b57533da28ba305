// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/layer_key.hpp"

#include <cmath>

namespace grseg {

std::string KeyColumn::name_with_unit(int dimension) const
{
  return std::string(name) + (value == &LayerKey::volume ? unit_of_volume(dimension) : unit);
}

const char* unit_of_volume(int dimension)
{
  return dimension == 3 ? "[m^3]" : "[m^2]";
}

std::vector<std::string> with_key_columns(int dimension, const std::vector<std::string>& more)
{
  std::vector<std::string> names;
  names.reserve(key_columns.size() + more.size());
  for (const auto& column : key_columns) names.push_back(column.name_with_unit(dimension));
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

bool RowRange::holds_window(const LayerKey& key) const
{
  const double slack = 1e-9 * (1 + std::abs(key.begin) + std::abs(key.end));
  return !(key.begin < begin - slack) && !(key.end > end + slack);
}

}  // namespace grseg
