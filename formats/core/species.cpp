// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/species.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace grseg {

SpeciesList two_sizes(double small_diameter, double large_diameter)
{
  return {{"small", small_diameter}, {"large", large_diameter}};
}

bool names_species(const SpeciesList& species)
{
  return species.size() != 2 || species[0].name != "small" || species[1].name != "large";
}

std::string species_text(const SpeciesList& species)
{
  std::string text;
  for (const auto& [name, diameter] : species)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, diameter);
  return text;
}

SpeciesList parse_species(const std::string& text)
{
  SpeciesList list;
  std::istringstream entries(text);
  for (std::string entry; std::getline(entries, entry, ',');) {
    std::istringstream words(entry);
    SpeciesEntry one;
    std::string rest;
    const bool good = words >> one.name >> one.diameter && !(words >> rest) &&
                      is_species_name(one.name) && one.diameter > 0 &&
                      (list.empty() || one.diameter >= list.back().diameter);
    if (!good) return {};
    list.push_back(one);
  }
  return list;
}

std::vector<std::string> column_words(const SpeciesList& species)
{
  if (species.size() == 2) return {"S", "L"};
  std::vector<std::string> words;
  words.reserve(species.size());
  for (const auto& one : species) words.push_back(one.name);
  return words;
}

bool is_species_name(const std::string& name)
{
  return !name.empty() && name.size() < longest_species_name && name != name_of_boundary &&
         name != "b" && std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
         });
}

std::vector<std::int32_t> species_numbers(const std::vector<Species>& species, std::size_t mobile)
{
  std::vector<std::int32_t> numbers;
  numbers.reserve(species.size());
  for (const auto kind : species)
    numbers.push_back(kind == Species::boundary ? static_cast<std::int32_t>(mobile)
                                                : static_cast<std::int32_t>(kind));
  return numbers;
}

template <int D>
Partners partners(const Grains& grains, const Frame<D>& frame, std::size_t contact)
{
  const auto i = static_cast<std::size_t>(frame.contacts.i[contact]);
  const auto j = frame.contacts.j[contact];
  if (!is_mobile(grains, i))
    throw FormatError(
        fmt::format("contact {} of the frame at t = {:.6g} s names boundary grain {} first; "
                    "the first grain of a contact must be a mobile one",
                    contact, frame.time, i));
  if (j < 0 || !is_mobile(grains, frame, static_cast<std::size_t>(j))) return {i, std::nullopt};
  return {i, static_cast<std::size_t>(j)};
}

template <int D>
PairType pair_type(const Grains& grains, const Frame<D>& frame, std::size_t contact)
{
  const auto [i, j] = partners(grains, frame, contact);
  const bool large = grains.species[i] == Species::large;
  if (!j) return large ? PairType::Lb : PairType::Sb;
  const bool other_large = grains.species[*j] == Species::large;
  if (large != other_large) return PairType::LS;
  return large ? PairType::LL : PairType::SS;
}

template Partners partners(const Grains&, const Frame<2>&, std::size_t);
template Partners partners(const Grains&, const Frame<3>&, std::size_t);
template PairType pair_type(const Grains&, const Frame<2>&, std::size_t);
template PairType pair_type(const Grains&, const Frame<3>&, std::size_t);

}  // namespace grseg
