// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/named_species.hpp"

#include "formats/import/common/text_source.hpp"
#include "formats/import/facts/type_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace grseg {
namespace {

/// A species on the command line, and the range of diameters of its grains.
struct Named {
  std::string name, types;
  TypeList list;
  double given = 0;  // nominal diameter; 0: not given
  double low = INFINITY, high = 0;

  bool holds_all() const { return types == "all"; }
  bool contains(const ArchiveGrains& grains, std::size_t g) const
  {
    return holds_all() || list.contains(grains.type[g]);
  }
  double nominal() const { return given > 0 ? given : (low + high) / 2; }
};

void require_a_name(const std::string& name, const std::string& text)
{
  if (!is_species_name(name))
    throw UsageError(fmt::format("--species {}: {}", in_quotes(text), rule_of_species_names));
}

double diameter_in(const std::string& word, const std::string& text)
{
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value) ||
      !(value > 0))
    throw UsageError(
        fmt::format("--species {}: {} is not a diameter", in_quotes(text), in_quotes(word)));
  return value;
}

Named parse(const std::string& text, const ArchiveGrains& grains)
{
  const auto equals = text.find('='), colon = text.find(':', equals);
  if (equals == std::string::npos)
    throw UsageError(fmt::format(
        "--species {} is not of the form NAME=TYPES or NAME=TYPES:DIAMETER, such as AM=1,2 or "
        "SE=3:4e-6",
        in_quotes(text)));
  const auto name = text.substr(0, equals);
  require_a_name(name, text);
  const auto types = text.substr(equals + 1, colon - equals - 1);
  return {name, types, TypeList(types == "all" ? "none" : types, "--species", grains),
          colon == std::string::npos ? 0 : diameter_in(text.substr(colon + 1), text)};
}

std::vector<Named> parse_all(const std::vector<std::string>& texts, const ArchiveGrains& grains)
{
  std::vector<Named> all;
  for (const auto& text : texts) {
    all.push_back(parse(text, grains));
    for (std::size_t k = 0; k + 1 < all.size(); ++k)
      if (all[k].name == all.back().name)
        throw UsageError(
            fmt::format("--species names {} twice; list all its types in one", all.back().name));
  }
  return all;
}

/// The place in `all` of the one species that the grain belongs to.
std::size_t place_of(const ArchiveGrains& grains, std::size_t g, const std::vector<Named>& all)
{
  const auto is_it = [&](const Named& species) { return species.contains(grains, g); };
  const auto found = std::find_if(all.begin(), all.end(), is_it);
  if (found == all.end())
    throw UsageError(fmt::format(
        "type {} of grain {} is in no --species; every type of a mobile grain must be in one",
        grains.type_word(grains.type[g]), grains.id[g]));
  const auto other = std::find_if(found + 1, all.end(), is_it);
  if (other != all.end())
    throw UsageError(fmt::format(
        "grain {} is in --species {} and in {}; every type of a mobile grain must be in one alone",
        grains.id[g], found->name, other->name));
  return static_cast<std::size_t>(found - all.begin());
}

std::string in_words(const Named& species)
{
  if (species.holds_all()) return fmt::format("{} all grains", species.name);
  return fmt::format("{} types {}", species.name, species.types);
}

}  // namespace

NamedSpecies assign_named_species(const ArchiveGrains& grains, const std::vector<bool>& boundary,
                                  const std::vector<std::string>& texts)
{
  auto all = parse_all(texts, grains);
  if (grains.type.empty() &&
      !std::all_of(all.begin(), all.end(), [](const Named& s) { return s.holds_all(); }))
    throw UsageError(
        "--species names types, but the grains of the archive have no types; --species NAME=all "
        "takes them as one species");
  std::vector<std::size_t> place(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (boundary[g]) continue;
    auto& species = all[place[g] = place_of(grains, g, all)];
    species.low = std::min(species.low, 2 * grains.radius[g]);
    species.high = std::max(species.high, 2 * grains.radius[g]);
  }
  for (const auto& species : all)
    if (species.given == 0 && species.high == 0)
      throw UsageError(
          fmt::format("--species {0}={1}: no mobile grain is of these types; leave it out, or give "
                      "its diameter, {0}={1}:DIAMETER",
                      species.name, species.types));

  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return all[a].nominal() < all[b].nominal();
  });
  NamedSpecies found;
  std::vector<Species> number(all.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto& species = all[order[k]];
    number[order[k]] = static_cast<Species>(k);
    found.list.push_back({species.name, species.given});
    found.sizes += (k == 0 ? "" : ", ") + in_words(species);
  }
  found.sizes = "in order of size: " + found.sizes;
  for (std::size_t g = 0; g < grains.size(); ++g)
    found.species.push_back(boundary[g] ? Species::boundary : number[place[g]]);
  return found;
}

}  // namespace grseg
