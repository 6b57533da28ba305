// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/contact_sums_reader.hpp"

#include "analysis/frames/layer_table.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace grseg {
namespace {

/// Where the table's column of a sum was made with another exponent than the rule has.
void require_same_power(const Table& table, const PartitionRule& rule, const std::string& remedy)
{
  if (table.header_number("power") != rule.value)
    throw FormatError(fmt::format("{}: its column Mpower_* was made with power:{}; {}", table.name,
                                  table.header_text("power"), remedy));
}

InTables tables_with(Tensor2 ContactSums::*sum)
{
  return std::find_if(contact_sum_columns.begin(), contact_sum_columns.end(),
                      [sum](const auto& column) { return column.sum == sum; })
      ->in;
}

/// Whether the sum is that of a rule which is not among `rules`: older tables may lack it.
bool is_of_other_rule(Tensor2 ContactSums::*sum, const std::vector<PartitionRule>& rules)
{
  const auto all = rule_definitions();
  return std::any_of(all.begin(), all.end(), [sum](const auto& rule) { return rule.sum == sum; }) &&
         std::none_of(rules.begin(), rules.end(),
                      [sum](const auto& rule) { return rule.definition().sum == sum; });
}

}  // namespace

ContactSumsReader::ContactSumsReader(const Table& table, const std::vector<PartitionRule>& rules)
    : table_(table)
{
  const auto add_columns = [&](InTables in, const std::string& remedy) {
    for (const auto& column : contact_sum_columns) {
      if (column.in != in) continue;
      if (is_of_other_rule(column.sum, rules) &&
          !table.has_column(column.name + std::string("_xx")))
        continue;
      auto& place = places_.emplace_back(Place{column.sum, {}});
      for (std::size_t c = 0; c < tensor_components.size(); ++c)
        place.columns[c] =
            find_kept_column(table, column_name(column, tensor_components[c]), remedy);
    }
  };
  const std::string remedy = "a table of grseg-stress has it";
  volume_ = find_column(table, volume_column.name_with_unit(), remedy);
  for (std::size_t k = 0; k < areas_.size(); ++k)
    areas_[k] = find_column(table, area_columns[k].name, remedy);
  add_columns(InTables::all, remedy);
  bool has_power = false;
  for (const auto& rule : rules) {
    const auto& definition = rule.definition();
    const bool same_for_all = definition.share != nullptr && definition.sum == nullptr;
    if (same_for_all && !at_centres_ && table.has_column("ML_xx")) {
      add_columns(InTables::at_centres, "make the table anew with grseg-stress --assign grain");
      at_centres_ = true;
    }
    if (definition.sum == nullptr || tables_with(definition.sum) != InTables::power) continue;
    const auto how = fmt::format("make the table with grseg-stress --partition {}", rule.name());
    if (!has_power) add_columns(InTables::power, how);
    has_power = true;
    require_same_power(table, rule, how);
  }
}

ContactSums ContactSumsReader::read(std::size_t row) const
{
  ContactSums sums;
  sums.at_centres = at_centres_;
  sums.volume = finite_cell(table_, row, volume_);
  constexpr double round_off = 1e-12;  // of the volume: areas are differences of larger ones
  for (std::size_t k = 0; k < areas_.size(); ++k)
    sums.*area_columns[k].area = non_negative_cell(table_, row, areas_[k], round_off * sums.volume);
  for (const auto& [sum, columns] : places_)
    for (std::size_t c = 0; c < columns.size(); ++c)
      (sums.*sum)(tensor_components[c].row, tensor_components[c].column) =
          columns[c] ? finite_cell(table_, row, *columns[c])
                     : std::numeric_limits<double>::quiet_NaN();
  return sums;
}

}  // namespace grseg
