// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/partial_stress.hpp"

#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace grseg {
namespace {

/// Stress sums over contacts of mobile grains, N m, by species; `dropped` belongs to none (`drop`).
template <int D>
struct Shares {
  std::vector<Tensor<D>> of_species;
  Tensor<D> dropped = Tensor<D>::Zero();
};

/// Calls share(a, b, pair) for all pairs of species a < b.
template <class Share>
void for_each_pair(std::size_t species, const Share& share)
{
  for (std::size_t b = 1; b < species; ++b)
    for (std::size_t a = 0; a < b; ++a) share(a, b, pair_index(a, b));
}

template <int D>
Shares<D> without_mixed(const ContactSums<D>& sums, OwnSum own)
{
  Shares<D> shares;
  for (std::size_t k = 0; k < sums.species(); ++k) shares.of_species.push_back(sums.of(own, k));
  return shares;
}

/// Shares under a rule that assigns the share `p` of every mixed contact to its larger grain.
template <int D>
Shares<D> same_for_all(const ContactSums<D>& sums, double p)
{
  auto shares = without_mixed(sums, sums.at_centres ? OwnSum::halves : OwnSum::inside);
  for_each_pair(sums.species(), [&](std::size_t a, std::size_t b, std::size_t pair) {
    auto &smaller = shares.of_species[a], &larger = shares.of_species[b];
    if (sums.at_centres) {
      smaller += (1 - p) * sums.of(PairSum::at_smaller, pair);
      larger += p * sums.of(PairSum::at_larger, pair);
    } else {
      const auto& whole = sums.of(PairSum::whole, pair);
      smaller += whole - p * whole;
      larger += p * whole;
    }
  });
  return shares;
}

template <int D>
Shares<D> shares_of(const ContactSums<D>& sums, const PartitionRule& rule)
{
  const auto& definition = rule.definition();
  if (definition.share != nullptr && !definition.sum)
    return same_for_all(sums, definition.share({}, rule.value));
  auto shares = without_mixed(sums, OwnSum::inside);
  for_each_pair(sums.species(), [&](std::size_t a, std::size_t b, std::size_t pair) {
    const auto& whole = sums.of(PairSum::whole, pair);
    if (definition.share == nullptr) {
      shares.dropped += whole;
    } else {
      const auto& of_larger = sums.of(*definition.sum, pair);
      shares.of_species[a] += whole - of_larger;
      shares.of_species[b] += of_larger;
    }
  });
  return shares;
}

template <int D>
Tensor<D> base_part(const ContactSums<D>& sums, std::size_t species, BasePart base)
{
  if (base == BasePart::contact_point) return sums.of(OwnSum::base, species);
  if (base == BasePart::half) return 0.5 * sums.of(OwnSum::whole_base, species);
  return Tensor<D>::Zero();
}

}  // namespace

template <int D>
PartialStress<D> partial_stress(const ContactSums<D>& sums, const PartitionRule& rule,
                                BasePart base, StressVolume volume)
{
  const auto shares = shares_of(sums, rule);
  const double v = volume == StressVolume::bulk
                       ? sums.volume
                       : std::accumulate(sums.content.begin(), sums.content.end(), 0.0);
  PartialStress<D> stress{{}, Tensor<D>::Zero()};
  for (const auto& own : shares.of_species) stress.total += own;
  stress.total += shares.dropped;
  for (std::size_t k = 0; k < sums.species(); ++k) {
    const Tensor<D> at_base = base_part(sums, k, base);
    stress.of_species.push_back((shares.of_species[k] + at_base) / v);
    stress.total += at_base;
  }
  stress.total /= v;
  return stress;
}

template PartialStress<2> partial_stress(const ContactSums<2>&, const PartitionRule&, BasePart,
                                         StressVolume);
template PartialStress<3> partial_stress(const ContactSums<3>&, const PartitionRule&, BasePart,
                                         StressVolume);

template <int D>
std::vector<Cell> stress_fields(const ContactSums<D>& sums, const SpeciesList& species,
                                const MapStress& how)
{
  const char* unit = D == 3 ? "[Pa]" : "[N/m]";
  const double solid = std::accumulate(sums.content.begin(), sums.content.end(), 0.0);
  std::vector<Cell> fields{{"nu", solid / sums.volume}};
  const auto words = column_words(species);
  for (std::size_t k = words.size() == 2 ? 1 : 0; k < words.size(); ++k)
    fields.push_back({"phi_" + words[k], ratio(sums.content[k], solid)});
  const Tensor<D> stress = partial_stress(sums, how.rule, how.base, how.volume).total;
  fields.push_back({std::string("pressure") + unit, stress.trace() / D});
  fields.push_back({std::string("sigma_yy") + unit, stress(1, 1)});
  fields.push_back({"stress_ratio", ratio(-stress(0, 1), stress(1, 1))});
  return fields;
}

template std::vector<Cell> stress_fields(const ContactSums<2>&, const SpeciesList&,
                                         const MapStress&);
template std::vector<Cell> stress_fields(const ContactSums<3>&, const SpeciesList&,
                                         const MapStress&);

namespace {

/// Throws FormatError if the table's columns Mpower have another exponent than the rule.
void require_same_power(const Table& table, const PartitionRule& rule, const std::string& remedy)
{
  if (table.header_number("power") != rule.value)
    throw FormatError(fmt::format("{}: its column Mpower_* was made with power:{}; {}", table.name,
                                  table.header_text("power"), remedy));
}

InTables tables_with(PairSum sum)
{
  return std::ranges::find_if(contact_sum_columns,
                              [sum](const auto& columns) {
                                return columns.of_pairs &&
                                       columns.sum == static_cast<std::size_t>(sum);
                              })
      ->in;
}

/// True if only rules that are not among `rules` need the sum, which older tables may lack.
bool is_of_other_rule(const ContactSumColumns& columns, const std::vector<PartitionRule>& rules)
{
  if (!columns.of_pairs) return false;
  const auto has_it = [&](const RuleDefinition& rule) {
    return rule.sum == static_cast<PairSum>(columns.sum);
  };
  const auto all = rule_definitions();
  return std::ranges::any_of(all, has_it) &&
         std::ranges::none_of(rules, [&](const auto& rule) { return has_it(rule.definition()); });
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
  at_centres_ = is_at_centres();
  if (at_centres_)
    add_columns(InTables::at_centres, rules,
                "make the table again with grseg-stress --assign grain");
  bool has_power = false;
  for (const auto& rule : rules) {
    const auto& definition = rule.definition();
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
  return std::ranges::any_of(sums, [&](const NamedSum& sum) {
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
  constexpr double round_off = 1e-12;  // relative to V; contents are differences of larger numbers
  for (std::size_t k = 0; k < contents_.size(); ++k)
    sums.content[k] = non_negative_cell(table_, row, contents_[k], round_off * sums.volume);
  for (const auto& [sum, columns] : places_)
    for (std::size_t c = 0; c < columns.size(); ++c)
      sum.in(sums)(components_[c].row, components_[c].column) =
          columns[c] ? finite_cell(table_, row, *columns[c]) : no_number;
  return sums;
}

}  // namespace grseg
