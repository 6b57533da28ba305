// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/flow_of_table.hpp"

#include "analysis/frames/layer_key.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/species.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <sstream>
#include <utility>

namespace grseg {
namespace {

constexpr FlowLine lines_of_flow[] = {{"dimension", "", "dimension"},
                                      {"species", "", "species", diameter_tolerance},
                                      {"small_diameter", "[m]", "diameters", diameter_tolerance},
                                      {"large_diameter", "[m]", "diameters", diameter_tolerance},
                                      {"density", "", "density"},
                                      {"friction", "", "friction"},
                                      {"restitution", "", "restitution"},
                                      {"gravity_x", "[m/s^2]", "gravity"},
                                      {"gravity_y", "[m/s^2]", "gravity"},
                                      {"gravity_z", "[m/s^2]", "gravity"},
                                      {"step", "[s]", "step"},
                                      {"length", "[m]", "length of the cell"},
                                      {"length_z", "[m]", "length of the cell"}};

/// Keys of a scene that are not compared: they do not matter for the flow, or the composition or
/// another header line repeats them.
constexpr std::string_view keys_left_out[] = {
    "seed",        "duration",    "frame-interval", "burst",      "keep-deposition",
    "compression", "store",       "small-diameter", "size-ratio", "density",
    "friction",    "restitution", "gravity",        "slope",      "step",
    "length",      "phi-large",   "large-grains",   "width",      "dimension"};
constexpr std::string_view keys_in_metres[] = {
    "depth",        "base-diameter", "base-height-spread", "base-spacing", "drum-diameter",
    "column-width", "outlet",        "shake-amplitude"};

/// Keys of scenes, by their first letters, that act in one geometry only. Every scene states them,
/// some with values that follow from other keys.
constexpr std::pair<std::string_view, std::string_view> keys_of_geometry[] = {
    {"base-", "bed"},    {"shake-", "bed"},     {"drum-", "drum"},   {"fill", "drum"},
    {"plate-", "shear"}, {"column-", "column"}, {"outlet", "hopper"}};

/// True if the key has no effect in a scene of this geometry.
bool is_of_another(std::string_view key, std::string_view geometry)
{
  if (key == "depth") return geometry == "drum";
  const auto own = std::ranges::find_if(
      keys_of_geometry, [&](const auto& entry) { return key.starts_with(entry.first); });
  return own != std::end(keys_of_geometry) && own->second != geometry;
}

bool holds(std::span<const std::string_view> list, std::string_view word)
{
  return std::ranges::find(list, word) != list.end();
}

bool near(double a, double b, double tolerance)
{
  return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

/// True if names agree, and diameters to the relative `tolerance`.
bool same_species(const SpeciesList& a, const SpeciesList& b, double tolerance)
{
  return !a.empty() && std::equal(a.begin(), a.end(), b.begin(), b.end(),
                                  [&](const SpeciesEntry& x, const SpeciesEntry& y) {
                                    return x.name == y.name &&
                                           near(x.diameter, y.diameter, tolerance);
                                  });
}

}  // namespace

std::span<const FlowLine> flow_lines()
{
  return lines_of_flow;
}

bool agree(const Table& one, const Table& other, const FlowLine& line)
{
  const auto a = header_or(one, line.key, "unknown"), b = header_or(other, line.key, "unknown");
  if (a == b) return true;
  const auto x = parse_number(a), y = parse_number(b);
  if (x && y) return near(*x, *y, line.tolerance);
  return same_species(parse_species(a), parse_species(b), line.tolerance);
}

std::map<std::string, std::string> scene_of(const Table& table)
{
  std::map<std::string, std::string> scene;
  const bool turns = header_or(table, "gravity_x", "") == "nan";
  const auto is_left_out = [turns](const std::string& key) {
    return holds(keys_left_out, key) && !(turns && key == "slope");
  };
  std::istringstream words(header_or(table, "scene", ""));
  for (std::string word; std::getline(words >> std::ws, word, ';');) {
    const auto equals = word.find(" = ");
    if (equals != std::string::npos && !is_left_out(word.substr(0, equals)))
      scene[word.substr(0, equals)] = word.substr(equals + 3);
  }
  if (const auto geometry = scene.find("geometry"); geometry != scene.end())
    std::erase_if(scene, [own = geometry->second](const auto& entry) {
      return is_of_another(entry.first, own);
    });
  return scene;
}

std::string unit_of_key(std::string_view key)
{
  if (key == "slope-rate") return "[degree/s]";
  return holds(keys_in_metres, key) ? "[m]" : "";
}

std::vector<std::string> scene_differences(const Table& one, const Table& other)
{
  std::vector<std::string> keys;
  const auto theirs = scene_of(other);
  for (const auto& [key, value] : scene_of(one)) {
    const auto found = theirs.find(key);
    if (found == theirs.end() || found->second == value) continue;
    const auto x = parse_number(value), y = parse_number(found->second);
    if (!(x && y && near(*x, *y, 1e-6))) keys.push_back(key);
  }
  return keys;
}

std::vector<double> composition_of(const Table& table)
{
  const char* const remedy = "tables by layer and window have it";
  const auto keys = read_keys(table, remedy);
  std::vector<double> content;
  for (const auto& word : column_words(species_of(table))) {
    const auto name = fmt::format("{}_{}", dimension_of(table) == 3 ? "volume" : "area", word);
    const auto column = find_column(table, name + unit_of_volume(dimension_of(table)), remedy);
    auto& sum = content.emplace_back(0);
    for (std::size_t row = 0; row < keys.size(); ++row)
      if (!std::isnan(keys[row].bottom)) sum += keys[row].frames * table.rows[row][column];
  }
  const double all = std::accumulate(content.begin(), content.end(), 0.0);
  for (double& part : content) part = all > 0 ? part / all : 0;
  return content;
}

bool same_composition(const std::vector<double>& a, const std::vector<double>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](double x, double y) { return std::abs(x - y) <= composition_tolerance; });
}

std::string composition_words(const std::vector<double>& composition)
{
  return composition.size() <= 2 ? fmt::format("Phi_L = {:.2f}", composition.back())
                                 : fmt::format("Phi = {:.2f}", fmt::join(composition, "/"));
}

namespace {

/// Difference between the settings of two flows in words, "initial = mixed and large-below"; "" if
/// there is none.
std::string difference_of_settings(const Table& one, const Table& other)
{
  const auto words = [](const std::string& key, const std::string& a, const std::string& b) {
    return fmt::format("{} = {} and {}", key, printable(a), printable(b));
  };
  for (const auto& line : lines_of_flow)
    if (!agree(one, other, line))
      return words(line.key, header_or(one, line.key, "unknown"),
                   header_or(other, line.key, "unknown"));
  const auto keys = scene_differences(one, other);
  return keys.empty()
             ? ""
             : words(keys.front(), scene_of(one)[keys.front()], scene_of(other)[keys.front()]);
}

}  // namespace

void require_one_flow(const std::vector<Table>& tables, const std::vector<std::size_t>& run,
                      FlowsApart apart)
{
  const auto& first = tables.front();
  for (std::size_t k = 1; k < tables.size(); ++k) {
    auto difference = difference_of_settings(first, tables[k]);
    if (difference.empty() && apart == FlowsApart::by_any && run[k] != run.front()) {
      const auto a = composition_of(first), b = composition_of(tables[k]);
      if (!same_composition(a, b))
        difference = fmt::format("{} and {}", composition_words(a), composition_words(b));
    }
    if (!difference.empty())
      throw UsageError(
          fmt::format("{} and {} are of different flows ({}), and a mean over both is of neither; "
                      "give tables of one flow, which differ in their seed alone",
                      printable(first.name), printable(tables[k].name), difference));
  }
}

}  // namespace grseg
