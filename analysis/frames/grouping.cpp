// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/grouping.hpp"

#include "analysis/frames/sums.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace grseg {
namespace {

constexpr std::size_t no_one = static_cast<std::size_t>(-1);

std::vector<std::string> words_of(const std::string& text)
{
  std::vector<std::string> words;
  std::istringstream list(text);
  for (std::string word; std::getline(list, word, ',');) words.push_back(word);
  return words;
}

std::size_t find_species(const SpeciesList& species, const std::string& word,
                         const std::string& option)
{
  if (const auto found = number_of_species(word, species)) return *found;
  std::string all;  // "1 small, 2 large"
  for (std::size_t k = 0; k < species.size(); ++k)
    all += fmt::format("{}{} {}", k == 0 ? "" : ", ", k + 1, species[k].name);
  throw UsageError(
      fmt::format("--group {}: the run has no species '{}'; it has {}", option, word, all));
}

struct Groups {
  std::vector<std::string> names;
  std::vector<std::size_t> of_species;  // index in `names`, for every species of the run
};

Groups parse_groups(const SpeciesList& species, const std::vector<std::string>& options)
{
  Groups groups{{}, std::vector<std::size_t>(species.size(), no_one)};
  for (const auto& option : options) {
    const auto sign = option.find('=');
    const auto name = option.substr(0, sign);
    if (sign != std::string::npos && (name == "b" || name == name_of_boundary))
      throw UsageError(
          fmt::format("--group {}: '{}' denotes boundary grains in columns; choose another name",
                      option, name));
    if (sign == std::string::npos || !is_species_name(name))
      throw UsageError(fmt::format(
          "--group {}: write NAME=LIST, e.g. AM=1,2, with a name of at most 15 letters, digits, "
          "'_', '-' or '.'",
          option));
    if (std::ranges::find(groups.names, name) != groups.names.end())
      throw UsageError(fmt::format("--group {} is given twice; list all its species once", name));
    for (const auto& word : words_of(option.substr(sign + 1))) {
      auto& group = groups.of_species[find_species(species, word, option)];
      if (group != no_one)
        throw UsageError(fmt::format("--group {}: species {} is in two groups", option, word));
      group = groups.names.size();
    }
    groups.names.push_back(name);
  }
  for (std::size_t k = 0; k < species.size(); ++k)
    if (groups.of_species[k] == no_one)
      throw UsageError(
          fmt::format("species {} ({}) is in no --group; add it to one", k + 1, species[k].name));
  return groups;
}

std::vector<double> parse_edges(const std::string& text, LengthUnits units)
{
  std::vector<double> edges;
  for (const auto& word : words_of(text)) edges.push_back(parse_length(word, "--edges", units));
  if (edges.empty() || !std::ranges::is_sorted(edges, std::less_equal<>()))
    throw UsageError(
        fmt::format("--edges {}: give diameters in increasing order, e.g. 2mm,3mm", text));
  return edges;
}

/// A size of mobile grains: diameter (m), and the share of all volume in smaller grains, 0 to 1.
struct Size {
  double diameter, below;
};

std::vector<Size> sizes_of(const Grains& grains, int dimension)
{
  constexpr double digits = 1e-9;  // relative difference up to which diameters count as equal
  std::vector<double> diameters;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g)) diameters.push_back(2 * grains.radius[g]);
  std::ranges::sort(diameters);
  std::vector<Size> sizes;
  double below = 0;
  for (const double d : diameters) {
    if (sizes.empty() || d > sizes.back().diameter * (1 + digits)) sizes.push_back({d, below});
    below += std::pow(d, dimension);
  }
  for (auto& size : sizes) size.below /= below;
  return sizes;
}

/// Diameters (m) that divide the mobile grains into classes of equal volume, as far as the sizes
/// allow: at each edge, the volume of smaller grains is as near as possible to k/classes of all.
std::vector<double> edges_of_classes(const Grains& grains, int dimension, int classes)
{
  const auto sizes = sizes_of(grains, dimension);
  const auto count = static_cast<std::size_t>(classes);
  if (sizes.size() < count)
    throw UsageError(
        fmt::format("--classes {}: the mobile grains have only {} different diameters; use at most "
                    "this many classes, or --edges",
                    classes, sizes.size()));
  std::vector<double> edges;
  std::size_t first = 1;
  for (std::size_t k = 1; k < count; ++k) {
    const double share = static_cast<double>(k) / classes;
    const auto begin = sizes.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = sizes.end() - static_cast<std::ptrdiff_t>(count - 1 - k);  // for later edges
    const auto nearest = std::min_element(begin, end, [&](const Size& a, const Size& b) {
      return std::abs(a.below - share) < std::abs(b.below - share);
    });
    edges.push_back(nearest->diameter);
    first = static_cast<std::size_t>(nearest - sizes.begin()) + 1;
  }
  return edges;
}

/// Grains of the run with new species, sorted by Sauter mean diameter: grain g belongs to
/// names[number_of(g)]. Throws UsageError if a species has no mobile grain.
template <class NumberOf>
GroupedGrains regrouped(const TrajectoryReader& run, const std::vector<std::string>& names,
                        const NumberOf& number_of)
{
  const auto& grains = run.grains();
  std::vector<double> volume(names.size()), surface(names.size());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, g)) continue;
    const double d = 2 * grains.radius[g];
    volume[number_of(g)] += std::pow(d, run.dimension());
    surface[number_of(g)] += std::pow(d, run.dimension() - 1);
  }
  for (std::size_t k = 0; k < names.size(); ++k)
    if (!(volume[k] > 0)) throw UsageError(fmt::format("no mobile grain belongs to {}", names[k]));
  std::vector<std::size_t> order(names.size()), rank(names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return volume[a] / surface[a] < volume[b] / surface[b];
  });
  GroupedGrains result{grains, {}};
  for (std::size_t k = 0; k < order.size(); ++k) {
    rank[order[k]] = k;
    result.species.push_back({names[order[k]], volume[order[k]] / surface[order[k]]});
  }
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g)) result.grains.species[g] = static_cast<Species>(rank[number_of(g)]);
  return result;
}

}  // namespace

std::optional<std::size_t> number_of_species(const std::string& word, const SpeciesList& species)
{
  for (std::size_t k = 0; k < species.size(); ++k)
    if (word == species[k].name || word == std::to_string(k + 1)) return k;
  return {};
}

std::vector<std::string> names_of(const SpeciesList& species)
{
  return listed(species, &SpeciesEntry::name);
}

void GroupingOptions::add_to(po::options_description& options)
{
  options.add_options()("group", po::value(&groups)->composing()->value_name("NAME=LIST"),
                        "treat several species as one, called NAME: LIST has their numbers (from "
                        "1) or names, e.g. L=2,3; each species of the run must be in one group");
  options.add_options()("classes", po::value(&classes)->value_name("N"),
                        "divide the grains by diameter into N species of equal volume");
  options.add_options()("edges", po::value(&edges)->value_name("LENGTH,..."),
                        "divide the grains into species at these diameters, e.g. 2mm,3mm");
}

GroupedGrains group_grains(const TrajectoryReader& run, const GroupingOptions& options)
{
  const int given = !options.groups.empty() + (options.classes != 0) + !options.edges.empty();
  if (given > 1) throw UsageError("--group, --classes and --edges exclude each other; choose one");
  const auto& grains = run.grains();
  if (!options.groups.empty()) {
    const auto groups = parse_groups(run.species(), options.groups);
    auto result = regrouped(run, groups.names, [&](std::size_t g) {
      return groups.of_species[static_cast<std::size_t>(grains.species[g])];
    });
    for (std::size_t k = 0; k < run.species().size(); ++k) {
      const auto group = groups.of_species[k];
      if (std::ranges::count(groups.of_species, group) == 1)
        std::ranges::find(result.species, groups.names[group], &SpeciesEntry::name)->diameter =
            run.species()[k].diameter;
    }
    return result;
  }
  if (given == 0) return {grains, run.species()};
  if (options.edges.empty() && (options.classes < 1 || options.classes > 100))
    throw UsageError(fmt::format("--classes {}: it must be 1 to 100", options.classes));
  const auto edges = options.edges.empty()
                         ? edges_of_classes(grains, run.dimension(), options.classes)
                         : parse_edges(options.edges, {run.small_diameter(), run.large_diameter()});
  std::vector<std::string> names;
  for (std::size_t k = 0; k <= edges.size(); ++k) names.push_back(fmt::format("c{}", k + 1));
  return regrouped(run, names, [&](std::size_t g) {
    return static_cast<std::size_t>(std::ranges::upper_bound(edges, 2 * grains.radius[g]) -
                                    edges.begin());
  });
}

}  // namespace grseg
