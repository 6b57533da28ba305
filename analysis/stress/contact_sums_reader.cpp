// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/contact_sums_reader.hpp"

#include "analysis/frames/layer_table.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grseg {
namespace {

/// Where the table's column of a sum was made with another exponent than the rule has.
void require_same_power(const Table& table, const PartitionRule& rule, const std::string& remedy)
{
  if (table.header_number("power") != rule.value)
    throw FormatError(fmt::format("{}: its column Mpower_* was made with power:{}; {}", table.name,
                                  table.header_text("power"), remedy));
}

InTables tables_with(PairSum sum)
{
  return std::find_if(contact_sum_columns.begin(), contact_sum_columns.end(),
                      [sum](const auto& columns) {
                        return columns.of_pairs && columns.sum == static_cast<std::size_t>(sum);
                      })
      ->in;
}

/// Whether the sum is that of a rule which is not among `rules`: older tables may lack it.
bool is_of_other_rule(const ContactSumColumns& columns, const std::vector<PartitionRule>& rules)
{
  if (!columns.of_pairs) return false;
  const auto has_it = [&](const RuleDefinition& rule) {
    return rule.sum == static_cast<PairSum>(columns.sum);
  };
  const auto all = rule_definitions();
  return std::any_of(all.begin(), all.end(), has_it) &&
         std::none_of(rules.begin(), rules.end(),
                      [&](const auto& rule) { return has_it(rule.definition()); });
}

}  // namespace

ContactSumsReader::ContactSumsReader(const Table& table, const std::vector<PartitionRule>& rules)
    : table_(table),
      species_(species_of(table)),
      components_(tensor_components(dimension_of(table)))
{
  const std::string remedy = "a table of grseg-stress has it";
  const int dimension = dimension_of(table);
  volume_ = find_column(table, volume_column.name_with_unit(dimension), remedy);
  for (const auto& name : content_columns(species_, dimension))
    contents_.push_back(find_column(table, name, remedy));
  add_columns(InTables::all, rules, remedy);
  bool has_power = false;
  for (const auto& rule : rules) {
    const auto& definition = rule.definition();
    const bool same_for_all = definition.share != nullptr && !definition.sum;
    if (same_for_all && !at_centres_ && is_at_centres()) {
      add_columns(InTables::at_centres, rules,
                  "make the table anew with grseg-stress --assign grain");
      at_centres_ = true;
    }
    if (!definition.sum || tables_with(*definition.sum) != InTables::power) continue;
    const auto how = fmt::format("make the table with grseg-stress --partition {}", rule.name());
    if (!has_power) add_columns(InTables::power, rules, how);
    has_power = true;
    require_same_power(table, rule, how);
  }
}

bool ContactSumsReader::is_at_centres() const
{
  const auto sums = named_sums(species_, InTables::at_centres);
  return std::any_of(sums.begin(), sums.end(), [&](const NamedSum& sum) {
    return sum.columns->of_pairs && table_.has_column(sum.name + "_xx");
  });
}

void ContactSumsReader::add_columns(InTables in, const std::vector<PartitionRule>& rules,
                                    const std::string& remedy)
{
  for (const auto& sum : named_sums(species_, in)) {
    if (is_of_other_rule(*sum.columns, rules) && !table_.has_column(sum.name + "_xx")) continue;
    auto& place = places_.emplace_back(Place{sum, {}});
    for (const auto& component : components_)
      place.columns.push_back(find_kept_column(table_, column_name(sum, component), remedy));
  }
}

ContactSums<3> ContactSumsReader::read(std::size_t row) const
{
  ContactSums<3> sums(species_.size());
  sums.at_centres = at_centres_;
  sums.volume = finite_cell(table_, row, volume_);
  constexpr double round_off = 1e-12;  // of the volume: contents are differences of larger ones
  for (std::size_t k = 0; k < contents_.size(); ++k)
    sums.content[k] = non_negative_cell(table_, row, contents_[k], round_off * sums.volume);
  for (const auto& [sum, columns] : places_)
    for (std::size_t c = 0; c < columns.size(); ++c)
      sum.in(sums)(components_[c].row, components_[c].column) =
          columns[c] ? finite_cell(table_, row, *columns[c]) : no_number;
  return sums;
}

}  // namespace grseg
