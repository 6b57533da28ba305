// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/species.hpp"

#include "formats/import/facts/named_species.hpp"
#include "formats/import/facts/number_list.hpp"
#include "formats/import/facts/proposals.hpp"
#include "formats/import/facts/type_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace grseg {
namespace {

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

/// The diameter that parts two sizes, half-way; none where they are not far apart.
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

Species by_type(const ArchiveGrains& grains, std::size_t g, const TypeList& small,
                const TypeList& large)
{
  const auto type = grains.type[g];
  if (small.contains(type) == large.contains(type))
    throw UsageError(fmt::format(
        "type {} of grain {} is {}; every type of a mobile grain must be in exactly one of them",
        grains.type_word(type), grains.id[g],
        small.contains(type) ? "in --small and in --large" : "neither in --small nor in --large"));
  return large.contains(type) ? Species::large : Species::small;
}

/// --species says all that the options of two sizes would say.
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
          fmt::format("{} does not go with --species; give types and nominal diameters as in "
                      "--species small=1:0.005 --species large=2:0.01",
                      option));
}

double diameter_that_splits(const std::vector<double>& diameter, const ArchiveGrains& grains,
                            const std::vector<bool>& boundary, const SpeciesSettings& settings)
{
  if (settings.split_diameter) return *settings.split_diameter;
  if (const auto gap = gap_between_sizes(diameter)) return *gap;
  throw OpenQuestions(question_of_species(grains, boundary, histogram(diameter)));
}

}  // namespace

SpeciesFound assign_species(const ArchiveGrains& grains, const SpeciesSettings& settings)
{
  SpeciesFound found;
  const auto boundary = boundary_grains(grains, settings, found.base);
  if (!settings.named.empty()) {
    require_alone(settings);
    auto named = assign_named_species(grains, boundary, settings.named);
    found.species = std::move(named.species);
    found.list = std::move(named.list);
    found.sizes = std::move(named.sizes);
    return found;
  }
  found.list = two_sizes(settings.small_diameter.value_or(0), settings.large_diameter.value_or(0));
  if (settings.small || settings.large) {
    require_types(grains, settings.small ? "--small" : "--large");
    const auto small = settings.small.value_or("none"), large = settings.large.value_or("none");
    const TypeList small_types(small, "--small", grains), large_types(large, "--large", grains);
    for (std::size_t g = 0; g < grains.size(); ++g)
      found.species.push_back(boundary[g] ? Species::boundary
                                          : by_type(grains, g, small_types, large_types));
    found.sizes = fmt::format("small are types {}, large types {}", small, large);
    return found;
  }
  std::vector<double> diameter;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (!boundary[g]) diameter.push_back(2 * grains.radius[g]);
  const double split = diameter_that_splits(diameter, grains, boundary, settings);
  for (std::size_t g = 0; g < grains.size(); ++g)
    found.species.push_back(boundary[g]                    ? Species::boundary
                            : 2 * grains.radius[g] < split ? Species::small
                                                           : Species::large);
  found.sizes =
      fmt::format("small are diameters below {:g}{}", split,
                  settings.split_diameter ? "" : ", half-way between two sizes far apart");
  return found;
}

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

}  // namespace grseg
