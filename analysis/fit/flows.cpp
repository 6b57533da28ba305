// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/flows.hpp"

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
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>

namespace grseg {
namespace {

/// Share of each species in the grains' area, volume or mass, over all rows of these tables weighted
/// by frames.
std::vector<double> composition_of(const std::vector<FitTable>& tables,
                                   const std::vector<std::size_t>& numbers)
{
  std::vector<double> content(tables[numbers.front()].species.size());
  for (const auto table : numbers)
    for (const auto& row : tables[table].rows)
      for (std::size_t k = 0; k < content.size(); ++k)
        content[k] += row.key.frames * row.sums.content[k];
  const double all = std::accumulate(content.begin(), content.end(), 0.0);
  for (double& part : content) part = all > 0 ? part / all : 0;
  return content;
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
    for (std::size_t k = 0; k < count; ++k) flow.tables.push_back(table++);
  }
  return flows;
}

/// Tables are compared in order of Phi_L, and those without a scene, which may be of any flow, last,
/// so that their own order has no effect.
std::vector<Flow> by_likeness(const std::vector<FitTable>& tables)
{
  std::vector<std::tuple<bool, double, std::size_t>> order;
  for (std::size_t k = 0; k < tables.size(); ++k)
    order.emplace_back(scene_of(*tables[k].table).empty(), composition_of(tables, {k}).back(), k);
  std::ranges::sort(order);
  std::vector<Flow> flows;
  for (const auto& [no_scene, phi_large, k] : order) {
    const auto composition = composition_of(tables, {k});
    const auto is_own = [&, k = k](const Flow& flow) {
      const auto& first = *tables[flow.tables.front()].table;
      return same_composition(flow.composition, composition) &&
             scene_differences(first, *tables[k].table).empty() &&
             std::ranges::all_of(flow_lines(), [&](const FlowLine& line) {
               return agree(first, *tables[k].table, line);
             });
    };
    const auto own = std::ranges::find_if(flows, is_own);
    if (own != flows.end())
      own->tables.push_back(k);
    else
      flows.push_back({{}, composition, {k}});
  }
  for (auto& flow : flows) std::ranges::sort(flow.tables);
  std::ranges::sort(flows, {}, [](const Flow& flow) { return flow.tables.front(); });
  return flows;
}

/// Slope of the base, degrees: the angle between gravity and the normal of the base.
double slope_of(const Table& table)
{
  return std::atan2(table.header_number("gravity_x"), -table.header_number("gravity_y")) * 180 /
         std::numbers::pi;
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
    add_setting(flow, key, unit_of_key(key), value == own.end() ? "unknown" : value->second);
  }
}

/// Sets the name and the settings of a flow from everything in which flows differ.
void describe(Flow& flow, const std::vector<Flow>& all, const std::vector<FitTable>& tables)
{
  const auto& own = *tables[flow.tables.front()].table;
  const auto of_flows =
      listed(all, [&](const Flow& one) { return tables[one.tables.front()].table; });
  const auto differ = [&](std::string_view key) {
    const auto& line = *std::ranges::find(flow_lines(), key, &FlowLine::key);
    return std::ranges::any_of(of_flows, [&](const Table* other) {
      return std::ranges::any_of(of_flows,
                                 [&](const Table* one) { return !agree(*one, *other, line); });
    });
  };
  flow.name = composition_words(flow.composition);
  const bool inclined = own.has_header("gravity_x") && own.has_header("gravity_y") &&
                        differ("gravity_x") && differ("gravity_y") && !differ("gravity_z");
  if (inclined) {
    flow.settings.emplace_back("slope[degree]", fmt::format("{:.12g}", slope_of(own)));
    flow.name += fmt::format(", slope = {:.4g} degrees", slope_of(own));
  }
  for (const auto& [key, unit, what, tolerance] : flow_lines()) {
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
  for (const auto& line : flow_lines()) {
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
  for (auto& flow : flows) flow.composition = composition_of(tables, flow.tables);
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
