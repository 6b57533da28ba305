// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/flows.hpp"

#include "analysis/frames/layer_key.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <span>
#include <sstream>
#include <string_view>

namespace grseg {
namespace {

/// A header line of a table that tells flows apart: its key, unit and meaning, and the largest
/// relative difference that still counts as one flow.
struct FlowLine {
  const char *key, *unit, *what;
  double tolerance = 1e-6;
};
constexpr FlowLine flow_lines[] = {{"dimension", "", "dimension"},
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

/// Keys and values of a table's line "# scene: KEY = VALUE; ..." without keys_left_out and keys of
/// other geometries; empty if the table has no such line. The slope at t = 0 counts where gravity turns, and so has no value.
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

bool agree(const Table& one, const Table& other, const FlowLine& line)
{
  const auto a = header_or(one, line.key, "unknown"), b = header_or(other, line.key, "unknown");
  if (a == b) return true;
  const auto x = parse_number(a), y = parse_number(b);
  if (x && y) return near(*x, *y, line.tolerance);
  return same_species(parse_species(a), parse_species(b), line.tolerance);
}

/// Keys that both tables' scenes state, with different values.
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

/// Share of each species in the grains' area, volume or mass, over all rows weighted by frames.
std::vector<double> composition_of(const FitTable& table)
{
  std::vector<double> content(table.species.size());
  for (const auto& row : table.rows)
    for (std::size_t k = 0; k < content.size(); ++k)
      content[k] += row.key.frames * row.sums.content[k];
  const double all = std::accumulate(content.begin(), content.end(), 0.0);
  for (double& part : content) part = all > 0 ? part / all : 0;
  return content;
}

bool same_composition(const std::vector<double>& a, const std::vector<double>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](double x, double y) { return std::abs(x - y) <= composition_tolerance; });
}

/// Numbers of tables of the flows, from a text like "4,4,2".
std::vector<std::size_t> counts_of(const std::string& grouping, std::size_t tables)
{
  std::vector<std::size_t> counts;
  std::istringstream words(grouping);
  for (std::string word; std::getline(words, word, ',');) {
    const bool number = word.size() < 7 && word.find_first_not_of("0123456789") == word.npos;
    counts.push_back(number && !word.empty() ? std::stoul(word) : 0);
  }
  const auto sum = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  if (std::ranges::find(counts, 0U) != counts.end() || sum != tables)
    throw UsageError(fmt::format(
        "--flows {}: write auto, or the number of tables of each flow, in the order of the tables "
        "and {} in all, as in 4,4,2",
        grouping, tables));
  return counts;
}

std::vector<Flow> by_count(const std::vector<FitTable>& tables, const std::string& grouping)
{
  std::vector<Flow> flows;
  std::size_t table = 0;
  for (const auto count : counts_of(grouping, tables.size())) {
    auto& flow = flows.emplace_back();
    flow.composition = composition_of(tables[table]);
    for (std::size_t k = 0; k < count; ++k) flow.tables.push_back(table++);
  }
  return flows;
}

std::vector<Flow> by_likeness(const std::vector<FitTable>& tables)
{
  std::vector<Flow> flows;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const auto composition = composition_of(tables[k]);
    const auto is_own = [&](const Flow& flow) {
      const auto& first = *tables[flow.tables.front()].table;
      return same_composition(flow.composition, composition) &&
             scene_differences(first, *tables[k].table).empty() &&
             std::ranges::all_of(flow_lines, [&](const FlowLine& line) {
               return agree(first, *tables[k].table, line);
             });
    };
    const auto own = std::ranges::find_if(flows, is_own);
    if (own != flows.end())
      own->tables.push_back(k);
    else
      flows.push_back({{}, composition, {k}});
  }
  return flows;
}

/// Slope of the base, degrees: the angle between gravity and the normal of the base.
double slope_of(const Table& table)
{
  return std::atan2(table.header_number("gravity_x"), -table.header_number("gravity_y")) * 180 /
         std::numbers::pi;
}

/// Composition in words: "Phi_L = 0.30", or "Phi = 0.2/0.3/0.5" for three species.
std::string composition_words(const Flow& flow)
{
  return flow.composition.size() <= 2
             ? fmt::format("Phi_L = {:.2f}", flow.phi_large())
             : fmt::format("Phi = {:.2f}", fmt::join(flow.composition, "/"));
}

/// Adds a setting in which flows differ, to the flow's settings and to its name.
void add_setting(Flow& flow, const std::string& key, const std::string& unit,
                 const std::string& value)
{
  const auto number = parse_number(value);
  flow.settings.emplace_back(key + unit, value);
  flow.name += fmt::format(", {} = {}", key, number ? fmt::format("{:.4g}", *number) : value);
}

/// Adds the scene keys in which flows differ to the flow's settings and name.
void describe_scene(Flow& flow, const std::vector<const Table*>& tables, const Table& table)
{
  std::set<std::string> keys;
  for (const auto* one : tables)
    for (const auto* other : tables)
      for (auto& key : scene_differences(*one, *other)) keys.insert(key);
  const auto own = scene_of(table);
  for (const auto& key : keys) {
    const auto value = own.find(key);
    add_setting(flow, key,
                holds(keys_in_metres, key) ? "[m]"
                : key == "slope-rate"      ? "[degree/s]"
                                           : "",
                value == own.end() ? "unknown" : value->second);
  }
}

/// Sets the name and the settings of a flow from everything in which flows differ.
void describe(Flow& flow, const std::vector<Flow>& all, const std::vector<FitTable>& tables)
{
  const auto& own = *tables[flow.tables.front()].table;
  const auto of_flows =
      listed(all, [&](const Flow& one) { return tables[one.tables.front()].table; });
  const auto differ = [&](std::string_view key) {
    const auto& line = *std::ranges::find(flow_lines, key, &FlowLine::key);
    return std::ranges::any_of(of_flows, [&](const Table* other) {
      return std::ranges::any_of(of_flows,
                                 [&](const Table* one) { return !agree(*one, *other, line); });
    });
  };
  flow.name = composition_words(flow);
  const bool inclined = own.has_header("gravity_x") && own.has_header("gravity_y") &&
                        differ("gravity_x") && differ("gravity_y") && !differ("gravity_z");
  if (inclined) {
    flow.settings.emplace_back("slope[degree]", fmt::format("{:.12g}", slope_of(own)));
    flow.name += fmt::format(", slope = {:.4g} degrees", slope_of(own));
  }
  for (const auto& [key, unit, what, tolerance] : flow_lines) {
    if (!differ(key) || (inclined && std::string(key).starts_with("gravity"))) continue;
    add_setting(flow, key, unit, header_or(own, key, "unknown"));
  }
  describe_scene(flow, of_flows, own);
}

}  // namespace

std::string grouping_words(const std::string& grouping, const std::vector<Table>& tables)
{
  if (grouping != "auto") return "as given: " + grouping + " tables";
  std::vector<std::string> recorded;
  for (const auto& line : flow_lines) {
    const bool known = std::ranges::any_of(tables, [&](const Table& table) {
      return header_or(table, line.key, "unknown") != "unknown";
    });
    if (known && (recorded.empty() || recorded.back() != line.what))
      recorded.emplace_back(line.what);
  }
  if (std::ranges::any_of(tables, [](const Table& table) { return table.has_header("scene"); }))
    recorded.emplace_back("keys of the scene");
  return fmt::format(
      "runs of one flow agree in what their tables record of the flow ({}), diameters to {:g} %, "
      "and in overall composition, to {:g}",
      fmt::join(recorded, ", "), 100 * diameter_tolerance, composition_tolerance);
}

std::vector<Flow> find_flows(std::vector<FitTable>& tables, const std::string& grouping)
{
  auto flows = grouping == "auto" ? by_likeness(tables) : by_count(tables, grouping);
  std::ranges::stable_sort(flows, [](const Flow& a, const Flow& b) {
    return std::round(100 * a.phi_large()) < std::round(100 * b.phi_large());
  });
  for (std::size_t m = 0; m < flows.size(); ++m) {
    describe(flows[m], flows, tables);
    for (const auto table : flows[m].tables) tables[table].flow = m;
  }
  return flows;
}

FitData of_windows(const FitData& data, const std::vector<bool>& keep)
{
  FitData part{.quantity = data.quantity,
               .dimension = data.dimension,
               .tables = data.tables,
               .species = data.species,
               .window = data.window,
               .count = data.count};
  std::vector<std::size_t> window_of;  // for each window of `data`, its index in `part`
  std::size_t own = 0;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    const auto before = own;
    for (std::size_t k = 0; k < data.runs[run]; ++k)
      window_of.push_back(keep[window_of.size()] ? own++ : own);
    if (own == before) continue;
    part.runs.push_back(own - before);
    part.flows.push_back(data.flow_of(run));
  }
  std::map<std::size_t, std::size_t> rows;
  const auto row_of = [&](std::size_t row) {
    const auto [entry, fresh] = rows.try_emplace(row, part.rows.size());
    if (fresh) part.rows.push_back(data.rows[row]);
    return entry->second;
  };
  for (auto sample : data.samples) {
    if (!keep[sample.window]) continue;
    sample.window = window_of[sample.window];
    sample.row = row_of(sample.row);
    for (auto& next : sample.beside) next.renumber(row_of);
    part.samples.push_back(sample);
  }
  return part;
}

FitData of_flow(const FitData& data, std::size_t flow)
{
  std::vector<bool> keep;
  for (const auto of : data.flows_of_windows()) keep.push_back(of == flow);
  return of_windows(data, keep);
}

std::vector<double> weight_shares(const FitData& data, std::size_t flows)
{
  const auto flow_of = data.flows_of_windows();
  std::vector<double> shares(flows);
  for (const auto& sample : data.samples) shares[flow_of[sample.window]] += sample.weight_in_b();
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= all;
  return shares;
}

}  // namespace grseg
