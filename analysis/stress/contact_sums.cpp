// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/contact_sums.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

constexpr char letters[] = {'x', 'y', 'z'};

}  // namespace

std::vector<TensorComponent> tensor_components(int dimension)
{
  std::vector<TensorComponent> components;
  for (int row = 0; row < dimension; ++row)
    for (int column = 0; column < dimension; ++column)
      components.push_back({fmt::format("_{}{}", letters[row], letters[column]), row, column});
  return components;
}

std::vector<NamedSum> named_sums(const SpeciesList& species, InTables in)
{
  const auto words = column_words(species);
  const bool two = species.size() == 2;
  std::vector<NamedSum> named;
  for (const auto& sum : contact_sum_columns) {
    if (sum.in != in) continue;
    const auto name = [&](const std::string& smaller, const std::string& larger) {
      return fmt::format(fmt::runtime(two ? sum.of_two : sum.of_others), smaller, larger);
    };
    for (std::size_t b = 0; b < words.size(); ++b) {
      if (!sum.of_pairs) named.push_back({name(words[b], words[b]), &sum, b});
      for (std::size_t a = 0; sum.of_pairs && a < b; ++a)
        named.push_back({name(words[a], words[b]), &sum, pair_index(a, b)});
    }
  }
  return named;
}

std::vector<NamedSum> named_sums(const SpeciesList& species, const TableKind& kind)
{
  std::vector<NamedSum> all;
  for (const auto in : {InTables::all, InTables::at_centres, InTables::power})
    if (kind.has(in)) add_all(all, named_sums(species, in));
  return all;
}

std::string column_name(const NamedSum& sum, const TensorComponent& component)
{
  return fmt::format("{}{}[N m]", sum.name, component.suffix);
}

std::vector<std::string> content_columns(const SpeciesList& species, int dimension)
{
  return listed(column_words(species), [&](const std::string& word) {
    return dimension == 3 ? fmt::format("volume_{}[m^3]", word) : fmt::format("area_{}[m^2]", word);
  });
}

std::vector<std::string> contact_number_columns(const SpeciesList& species)
{
  const auto words = column_words(species);
  const bool two = words.size() == 2;
  std::vector<std::string> names;
  for (std::size_t b = 0; b < words.size(); ++b)
    for (std::size_t a = 0; a <= b; ++a)
      names.push_back(two      ? fmt::format("n_{}{}", words[b], words[a])
                      : a == b ? fmt::format("n_{}", words[a])
                               : fmt::format("n_{}+{}", words[a], words[b]));
  for (const auto& word : words) names.push_back(fmt::format("n_{}{}b", word, two ? "" : "+"));
  return names;
}

std::vector<std::string> sum_column_names(const SpeciesList& species, const TableKind& kind)
{
  std::vector<std::string> names;
  const auto components = tensor_components(kind.dimension);
  for (const auto& sum : named_sums(species, kind))
    for (const auto& component : components) names.push_back(column_name(sum, component));
  return names;
}

template <int D>
std::vector<double> sum_cells(const ContactSums<D>& sums, const TableKind& kind)
{
  std::vector<double> cells;
  const auto components = tensor_components(D);
  const SpeciesList without_names(sums.species());
  for (const auto& sum : named_sums(without_names, kind))
    for (const auto& component : components)
      cells.push_back(sum.in(sums)(component.row, component.column));
  return cells;
}

template std::vector<double> sum_cells(const ContactSums<2>&, const TableKind&);
template std::vector<double> sum_cells(const ContactSums<3>&, const TableKind&);

}  // namespace grseg
