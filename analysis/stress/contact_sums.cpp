// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/contact_sums.hpp"

#include <fmt/format.h>

namespace grseg {

ContactSums& ContactSums::operator+=(const ContactSums& others)
{
  volume += others.volume;
  for (const auto& column : area_columns) this->*column.area += others.*column.area;
  for (const auto& column : contact_sum_columns) this->*column.sum += others.*column.sum;
  at_centres |= others.at_centres;
  return *this;
}

ContactSums ContactSums::operator/(double number) const
{
  ContactSums part = *this;
  part.volume /= number;
  for (const auto& column : area_columns) part.*column.area /= number;
  for (const auto& column : contact_sum_columns) part.*column.sum /= number;
  return part;
}

std::string column_name(const ContactSumColumns& sum, const Component2& component)
{
  return fmt::format("{}{}[N m]", sum.name, component.suffix);
}

std::vector<std::string> sum_column_names(const TableKind& kind)
{
  std::vector<std::string> names;
  for (const auto& column : contact_sum_columns)
    if (kind.has(column.in))
      for (const auto& component : tensor_components)
        names.push_back(column_name(column, component));
  return names;
}

std::vector<double> sum_cells(const ContactSums& sums, const TableKind& kind)
{
  std::vector<double> cells;
  for (const auto& column : contact_sum_columns)
    if (kind.has(column.in))
      for (const auto& component : tensor_components)
        cells.push_back((sums.*column.sum)(component.row, component.column));
  return cells;
}

}  // namespace grseg
