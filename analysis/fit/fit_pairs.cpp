// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_pairs.hpp"

#include "analysis/fit/size_exponent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace grseg {
namespace {

std::size_t find_species(const std::string& word, const SpeciesList& species,
                         const std::string& text)
{
  std::string names;
  for (std::size_t k = 0; k < species.size(); ++k) {
    if (word == species[k].name || word == std::to_string(k + 1)) return k;
    names += fmt::format("{}{}", k == 0 ? "" : ", ", species[k].name);
  }
  throw UsageError(fmt::format("--pair {}: write two species of the table, as in {},{}; it has {}",
                               text, species.front().name, species.back().name, names));
}

}  // namespace

SpeciesPair parse_pair(const std::string& text, const SpeciesList& species)
{
  const auto comma = text.find(',');
  const auto a = find_species(text.substr(0, comma), species, text);
  const auto b =
      find_species(comma == std::string::npos ? "" : text.substr(comma + 1), species, text);
  if (a == b) throw UsageError(fmt::format("--pair {}: both are the same species", text));
  return {std::min(a, b), std::max(a, b)};
}

std::vector<RuleFit> fit_pairs(const std::vector<FitTable>& tables, Quantity quantity,
                               const FitFilters& filters, const std::vector<SpeciesPair>& pairs,
                               const std::vector<PartitionRule>& rules, const FitSettings& settings,
                               const Resampling& resampling, bool with_exponent)
{
  const auto data = select_fit_data(tables, quantity, filters, pairs);
  std::vector<RuleFit> fits;
  for (const auto& rule : rules) {
    const auto first = fits.size();
    for (const auto& pair : pairs) {
      auto of_pair =
          fit_flows(pairs.size() == 1 ? data : select_fit_data(tables, quantity, filters, {pair}),
                    rule, settings, resampling);
      if (settings.over == Over::automatic)
        fits.insert(fits.end(), of_pair.of_each.begin(), of_pair.of_each.end());
      fits.push_back(std::move(of_pair.all));
    }
    if (!with_exponent || !rule.adds_up()) continue;
    const auto exponent = size_exponent(data, rule, settings, resampling);
    for (auto fit = first; fit < fits.size(); ++fit)
      if (!fits[fit].flow) fits[fit].size_exponent = exponent;
  }
  return fits;
}

}  // namespace grseg
