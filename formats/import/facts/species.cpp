// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/species.hpp"

#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/import/common/frame_tools.hpp"
#include "formats/import/common/text_values.hpp"
#include "formats/import/facts/proposals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace grseg {
namespace {

std::optional<std::int64_t> whole(std::string_view text)
{
  std::int64_t number = 0;
  if (!parse_whole(text, number) || number < 0) return std::nullopt;
  return number;
}

/// A species named on the command line, and the range of diameters of its grains.
struct Named {
  std::string option, name, types;
  TypeList list;
  double given = 0;  // nominal diameter; 0: not given
  Range diameters = {};
  bool holds_all = false;  // true: TYPES of --species is the word "all"

  bool contains(const ArchiveGrains& grains, std::size_t g) const
  {
    return holds_all || list.contains(grains.type[g]);
  }
  double nominal() const { return given > 0 ? given : diameters.middle(); }
};

Named parse(const std::string& text, const ArchiveGrains& grains)
{
  const auto equals = text.find('='), colon = text.find(':', equals);
  if (equals == std::string::npos)
    throw UsageError(fmt::format(
        "--species {} is not of the form NAME=TYPES or NAME=TYPES:DIAMETER, such as AM=1,2 or "
        "SE=3:4e-6",
        in_quotes(text)));
  const auto name = text.substr(0, equals);
  if (!is_species_name(name))
    throw UsageError(fmt::format("--species {}: {}", in_quotes(text), rule_of_species_names));
  const auto types = text.substr(equals + 1, colon - equals - 1);
  double diameter = 0;
  if (colon != std::string::npos &&
      !(parse_finite(text.substr(colon + 1), diameter) && diameter > 0))
    throw UsageError(fmt::format("--species {}: {} is not a diameter", in_quotes(text),
                                 in_quotes(text.substr(colon + 1))));
  const bool all = types == "all";
  const TypeList list(all ? "none" : types, "--species", grains);
  return {"--species " + name, name, types, list, diameter, {}, all};
}

std::vector<Named> parse_all(const std::vector<std::string>& texts, const ArchiveGrains& grains)
{
  std::vector<Named> all;
  for (const auto& text : texts) {
    all.push_back(parse(text, grains));
    for (std::size_t k = 0; k + 1 < all.size(); ++k)
      if (all[k].name == all.back().name)
        throw UsageError(fmt::format("--species names {} twice; list all its types in one option",
                                     all.back().name));
  }
  return all;
}

/// Index in `all` of the species of the grain. Throws UsageError if it belongs to no species
/// (`none` is part of this message) or to several.
std::size_t place_of(const ArchiveGrains& grains, std::size_t g, const std::vector<Named>& all,
                     const char* none)
{
  const auto is_it = [&](const Named& species) { return species.contains(grains, g); };
  const auto found = std::find_if(all.begin(), all.end(), is_it);
  if (found == all.end())
    throw UsageError(
        fmt::format("type {} of grain {} is {}; every type of a "
                    "mobile grain must be in one species",
                    grains.type_word(grains.type[g]), grains.id[g], none));
  const auto other = std::find_if(found + 1, all.end(), is_it);
  if (other != all.end())
    throw UsageError(fmt::format(
        "grain {} is in {} and in {}; every type of a mobile grain must be in one species only",
        grains.id[g], found->option, other->option));
  return static_cast<std::size_t>(found - all.begin());
}

std::string in_words(const Named& species)
{
  if (species.holds_all) return fmt::format("{} all grains", species.name);
  return fmt::format("{} types {}", species.name, species.types);
}

constexpr double far_apart = 1.2;

void require_types(const ArchiveGrains& grains, const char* option)
{
  if (grains.type.empty())
    throw UsageError(
        fmt::format("{} names types, but the grains of the archive have no types", option));
}

std::vector<bool> boundary_grains(const ArchiveGrains& grains, const SpeciesSettings& settings,
                                  std::string& how)
{
  std::vector<bool> boundary(grains.size());
  if (settings.boundary_ids) {
    const NumberList ids(*settings.boundary_ids, "--boundary-ids");
    for (std::size_t g = 0; g < grains.size(); ++g) boundary[g] = ids.contains(grains.id[g]);
    how = "ids " + *settings.boundary_ids;
  } else if (settings.boundary) {
    const TypeList types(*settings.boundary, "--boundary", grains);
    if (*settings.boundary != "none") require_types(grains, "--boundary");
    for (std::size_t g = 0; g < grains.type.size(); ++g)
      boundary[g] = types.contains(grains.type[g]);
    how = *settings.boundary == "none" ? "none" : "types " + *settings.boundary;
  } else {
    for (std::size_t g = 0; g < grains.fixed.size(); ++g) boundary[g] = grains.fixed[g] != 0;
    how = "grains that the archive marks as fixed";
  }
  const bool any = std::find(boundary.begin(), boundary.end(), true) != boundary.end();
  const bool by_archive = !settings.boundary && !settings.boundary_ids;
  if (!any && by_archive) how = "none: the archive marks no grain as fixed";
  if (!any && !by_archive && how != "none")
    throw UsageError(fmt::format(
        "no grain belongs to the base ({}); if there is no base, pass --boundary none", how));
  return boundary;
}

/// The diameter half-way between two sizes far apart (species.hpp); empty if there are none.
std::optional<double> gap_between_sizes(std::vector<double> diameter)
{
  std::sort(diameter.begin(), diameter.end());
  std::size_t widest = 0;
  double factor = 1;
  for (std::size_t k = 1; k < diameter.size(); ++k)
    if (diameter[k] > factor * diameter[k - 1]) {
      factor = diameter[k] / diameter[k - 1];
      widest = k;
    }
  if (factor < far_apart) return std::nullopt;
  const double below = diameter[widest - 1] / diameter.front();
  const double above = diameter.back() / diameter[widest];
  if (std::max(below * below, above * above) >= factor) return std::nullopt;
  return (diameter[widest - 1] + diameter[widest]) / 2;
}

/// Throws UsageError if --species is combined with an option for two sizes.
void require_alone(const SpeciesSettings& settings)
{
  const std::pair<const char*, bool> of_two[] = {
      {"--small", settings.small.has_value()},
      {"--large", settings.large.has_value()},
      {"--split-diameter", settings.split_diameter.has_value()},
      {"--small-diameter", settings.small_diameter.has_value()},
      {"--large-diameter", settings.large_diameter.has_value()}};
  for (const auto& [option, given] : of_two)
    if (given)
      throw UsageError(
          fmt::format("{} cannot be combined with --species; write types and nominal diameters as "
                      "in --species small=1:0.005 --species large=2:0.01",
                      option));
}

/// Histogram of ten equal bins, without empty bins, as text: "0.0048 to 0.0052: 120, ...".
std::string histogram(std::vector<double> values)
{
  if (values.empty()) return "no grains";
  std::sort(values.begin(), values.end());
  const double low = values.front(), width = (values.back() - low) / 10;
  if (!(width > 0)) return fmt::format("{:g}: {}", low, values.size());
  std::string text;
  for (std::size_t k = 0; k < values.size();) {
    const double bin = std::min(9.0, std::floor((values[k] - low) / width));
    const auto begin = k;
    while (k < values.size() && std::min(9.0, std::floor((values[k] - low) / width)) == bin) ++k;
    text += fmt::format("{}{:.4g} to {:.4g}: {}", text.empty() ? "" : ", ", low + bin * width,
                        low + (bin + 1) * width, k - begin);
  }
  return text;
}

double diameter_that_splits(const std::vector<double>& diameter, const ArchiveGrains& grains,
                            const std::vector<bool>& boundary, const SpeciesSettings& settings)
{
  if (settings.split_diameter) return *settings.split_diameter;
  if (const auto gap = gap_between_sizes(diameter)) return *gap;
  throw OpenQuestions(question_of_species(grains, boundary, histogram(diameter)));
}

}  // namespace

NumberList::NumberList(const std::string& text, const std::string& option)
{
  if (text == "none") return;
  bool good = !text.empty() && text.back() != ',';
  for (const auto& part : parts_of(text, ',')) {
    if (!good) break;
    const auto dash = part.find('-');
    const auto first = whole(std::string_view(part).substr(0, dash));
    const auto last = dash == std::string::npos ? first : whole(part.substr(dash + 1));
    good = first && last && *first <= *last;
    if (good) ranges_.emplace_back(*first, *last);
  }
  if (!good)
    throw UsageError(
        fmt::format("{} '{}' is not a list of numbers, such as 3 or 1,4-9, or none", option, text));
}

bool NumberList::contains(std::int64_t number) const
{
  return std::any_of(ranges_.begin(), ranges_.end(), [&](const auto& range) {
    return range.first <= number && number <= range.second;
  });
}

TypeList::TypeList(const std::string& text, const std::string& option, const ArchiveGrains& grains)
    : numbers_(grains.type_names.empty() ? text : "none", option), named_(grains.type_names.size())
{
  if (text == "none") return;
  const auto& names = grains.type_names;
  if (names.empty()) return;
  for (const auto& word : parts_of(text, ',')) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) throw UsageError(unknown_word("type in " + option, word, names));
    named_[static_cast<std::size_t>(found - names.begin())] = true;
  }
}

bool TypeList::contains(std::int32_t type) const
{
  return named_.empty() ? numbers_.contains(type) : named_[static_cast<std::size_t>(type)];
}

SpeciesFound assign_named_species(const ArchiveGrains& grains, const std::vector<bool>& boundary,
                                  const std::vector<std::string>& texts)
{
  auto all = parse_all(texts, grains);
  if (grains.type.empty() &&
      !std::all_of(all.begin(), all.end(), [](const Named& s) { return s.holds_all; }))
    throw UsageError(
        "--species names types, but the grains of the archive have no "
        "types; --species NAME=all makes them one species");
  std::vector<std::size_t> place(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (!boundary[g])
      all[place[g] = place_of(grains, g, all, "in no --species")].diameters.add(2 *
                                                                                grains.radius[g]);
  for (const auto& species : all)
    if (species.given == 0 && species.diameters.high == 0)
      throw UsageError(
          fmt::format("--species {0}={1}: no mobile grain has these types; leave the option out, "
                      "or add the diameter, {0}={1}:DIAMETER",
                      species.name, species.types));

  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return all[a].nominal() < all[b].nominal();
  });
  SpeciesFound found;
  std::vector<Species> number(all.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto& species = all[order[k]];
    number[order[k]] = static_cast<Species>(k);
    found.list.push_back({species.name, species.given});
    found.sizes += (k == 0 ? "in order of size: " : ", ") + in_words(species);
  }
  for (std::size_t g = 0; g < grains.size(); ++g)
    found.species.push_back(boundary[g] ? Species::boundary : number[place[g]]);
  return found;
}

SpeciesFound assign_species(const ArchiveGrains& grains, const SpeciesSettings& settings)
{
  SpeciesFound found;
  std::string base;
  const auto boundary = boundary_grains(grains, settings, base);
  const auto add_each = [&](const auto& species_of) {
    found.list =
        two_sizes(settings.small_diameter.value_or(0), settings.large_diameter.value_or(0));
    for (std::size_t g = 0; g < grains.size(); ++g)
      found.species.push_back(boundary[g] ? Species::boundary : species_of(g));
  };
  if (!settings.named.empty()) {
    require_alone(settings);
    found = assign_named_species(grains, boundary, settings.named);
  } else if (settings.small || settings.large) {
    require_types(grains, settings.small ? "--small" : "--large");
    const auto small = settings.small.value_or("none"), large = settings.large.value_or("none");
    const std::vector<Named> both{{"--small", "", small, TypeList(small, "--small", grains)},
                                  {"--large", "", large, TypeList(large, "--large", grains)}};
    add_each([&](std::size_t g) {
      return static_cast<Species>(place_of(grains, g, both, "neither in --small nor in --large"));
    });
    found.sizes = fmt::format("small are types {}, large types {}", small, large);
  } else {
    std::vector<double> diameter;
    for (std::size_t g = 0; g < grains.size(); ++g)
      if (!boundary[g]) diameter.push_back(2 * grains.radius[g]);
    const double split = diameter_that_splits(diameter, grains, boundary, settings);
    add_each([&](std::size_t g) {
      return 2 * grains.radius[g] < split ? Species::small : Species::large;
    });
    found.sizes =
        fmt::format("small are diameters below {:g}{}", split,
                    settings.split_diameter ? "" : ", half-way between two sizes far apart");
  }
  found.base = base;
  return found;
}

}  // namespace grseg
