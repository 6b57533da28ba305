// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/partition_data.hpp"

#include "analysis/fit/fit_data.hpp"
#include "analysis/fit/fit_pairs.hpp"
#include "analysis/fit/flows.hpp"
#include "analysis/fit/make_report.hpp"
#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/runs_of_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;
using Kind = PartitionRule::Kind;

constexpr ScanRange grid{0, 1, 0.01};
constexpr ScanRange grid_of_layers{0, 1, 0.05};

/// Rules whose stresses are written into the page; the page computes stresses under other rules from them.
struct GivenRule {
  const char* name;
  PartitionRule rule;
};
constexpr GivenRule given_rules[] = {{"none", {Kind::uniform, 0}},
                                     {"all", {Kind::uniform, 1}},
                                     {"size", {Kind::size}},
                                     {"contact_point", {Kind::contact_point}},
                                     {"drop", {Kind::drop}}};

void add_points(const FitData& data, const FitSettings& settings, const std::string& prefix,
                BinaryArrays& arrays)
{
  const auto add = [&](const std::string& name, const auto& all, const auto& of) {
    std::vector<double> values(all.size());
    std::ranges::transform(all, values.begin(), of);
    arrays.add(prefix + name, values);
  };
  const auto points = fit_points(data, given_rules[0].rule, settings);
  add("phi_large", points, &FitPoint::phi_large);
  add("frames", points, &FitPoint::frames);
  add("window", points, &FitPoint::window);
  add("begin", data.samples, [](const LayerSample& sample) { return sample.key.begin; });
  add("bottom", data.samples, [](const LayerSample& sample) { return sample.key.bottom; });
  add("top", data.samples, [](const LayerSample& sample) { return sample.key.top; });
  for (const auto& [name, rule] : given_rules) {
    const auto of_rule = fit_points(data, rule, settings);
    add(std::string(name) + "_small", of_rule, &FitPoint::small);
    add(std::string(name) + "_large", of_rule, &FitPoint::large);
    if (rule.adds_up())
      add(std::string(name) + "_within", of_rule,
          [](const FitPoint& point) { return point.within * point.total; });
    else
      add(std::string(name) + "_total", of_rule, &FitPoint::total);
  }
}

/// Number of frames in all windows of the filter whose layers are as thick as this one.
double frames_of_all(const std::vector<FitTable>& tables, const RowFilter& filter,
                     const Span& layer)
{
  const double thickness = layer.second - layer.first;
  double frames = 0;
  for (const auto& table : tables) {
    std::map<Span, double> windows;
    for (const auto& row : table.rows)
      if (filter.holds_window(row.key) &&
          std::abs(row.key.top - row.key.bottom - thickness) < 1e-6 * thickness)
        windows[{row.key.begin, row.key.end}] = row.key.frames;
    for (const auto& [window, own] : windows) frames += own;
  }
  return frames;
}

/// Means of each layer over the times of the filter and all tables; the result looks like samples of a
/// single window. In windows that do not reach up to the layer it is empty.
FitData layer_means(const std::vector<FitTable>& tables, const RowFilter& filter,
                    const SpeciesPair& pair)
{
  std::map<Span, std::vector<const FitRow*>> rows;
  for (const auto& table : tables)
    for (const auto& row : table.rows)
      if (row.key.frames > 0 && filter.holds_window(row.key))
        rows[{row.key.bottom, row.key.top}].push_back(&row);
  FitData data;
  data.species = tables.front().species;
  for (const auto& table : tables) data.tables.push_back(table.table->name);
  data.dimension = dimension_of(*tables.front().table);
  data.runs = {1};
  for (const auto& [heights, of_layer] : rows) {
    LayerKey key = of_layer.front()->key;
    key.frames = 0;
    for (const auto* row : of_layer) key.frames += row->key.frames;
    ContactSums<3> mean(data.species.size());
    mean.at_centres = of_layer.front()->sums.at_centres;
    const double all = frames_of_all(tables, filter, heights);
    for (const auto* row : of_layer) mean += row->sums / (all / row->key.frames);
    mean.volume = of_layer.front()->sums.volume;
    const double small = mean.content[pair.smaller], large = mean.content[pair.larger];
    if (!(small + large > 0)) continue;
    data.samples.push_back({.phi_large = large / (small + large),
                            .frames = key.frames,
                            .row = data.rows.size(),
                            .pair = pair,
                            .key = key});
    data.rows.push_back(std::move(mean));
  }
  return data;
}

/// Data of all tables: by window and layer (`samples`), and as means over time (`layers`).
struct Selected {
  std::vector<FitTable> tables;
  FitData samples, layers;
};
Selected select(const std::vector<Table>& tables, const std::vector<PartitionRule>& rules,
                const PartitionSettings& settings)
{
  for (const auto& table : tables) refuse_map(table);
  Selected all{read_fit_tables(tables, Quantity::contact, rules), {}, {}};
  const auto& species = all.tables.front().species;
  if (species.size() < 2)
    throw RunError("there is one species of grains, and B compares two; make them with --classes");
  find_flows(all.tables, "auto");
  const auto pair = settings.pair.empty() ? SpeciesPair{} : parse_pair(settings.pair, species);
  all.samples = select_fit_data(all.tables, Quantity::contact, settings.filters, {pair});
  all.layers = layer_means(all.tables, settings.filters, pair);
  return all;
}

/// Adds the stresses of large grains under power:Q, for two species. The rest belongs to small grains.
void add_powers(const StressTables& input, const PartitionSettings& settings, BinaryArrays& arrays)
{
  std::vector<double> of_samples, of_layers;
  const auto nodes = power_nodes();
  for (std::size_t k = 0; k < input.of_powers.size(); ++k) {
    const PartitionRule rule{Kind::power, nodes[k]};
    const auto selected = select(input.of_powers[k], {rule}, settings);
    for (const auto& point : fit_points(selected.samples, rule, settings.fit))
      of_samples.push_back(point.large);
    for (const auto& point : fit_points(selected.layers, rule, settings.fit))
      of_layers.push_back(point.large);
  }
  arrays.add("power_large", of_samples);
  arrays.add("layer_power_large", of_layers);
}

Json with_interval(const Estimate& estimate)
{
  return Json::array({estimate.value, estimate.low, estimate.high});
}
Json b_with_interval(const RuleFit& fit)
{
  return with_interval({fit.value.B, fit.low.B, fit.high.B});
}

Json rule_object(const RuleFit& fit, const std::vector<Flow>& flows)
{
  return {{"name", fit.rule.name()},
          {"flow", fit.flow            ? flows[*fit.flow].name
                   : flows.size() == 1 ? ""
                                       : "all flows"},
          {"used_by", fit.rule.used_by()},
          {"share", fit.share},
          {"points", fit.points},
          {"over", word_of(fit.over, populations)},
          {"doubt", fit.doubt},
          {"B", b_with_interval(fit)}};
}

/// B with its interval for each share p; for two species also p*, the share at which B is 0.
Json scan_object(const Selected& selected, const PartitionSettings& settings)
{
  const auto scan = scan_partition(selected.samples, grid, settings.fit);
  Json object{{"p", grid.shares()}, {"B", Json::array()}, {"doubts", Json::array()}};
  for (const auto& fit : scan.fits) {
    object["B"].push_back(b_with_interval(fit));
    object["doubts"].push_back(fit.doubt);
  }
  if (selected.samples.species.size() <= 2)
    object["p_zero"] = with_interval(scan.line.p_zero.estimate());
  return object;
}

/// The samples of one layer, in the windows that have one.
FitData of_layer(FitData data, const std::pair<double, double>& layer)
{
  std::erase_if(data.samples, [&](const LayerSample& sample) {
    return std::pair(sample.key.bottom, sample.key.top) != layer;
  });
  std::vector<bool> keep(number_of_windows(data.runs));
  for (const auto& sample : data.samples) keep[sample.window] = true;
  return of_windows(data, keep);
}

/// B of each layer with its interval for each share p.
Json layers_object(const Selected& selected, const PartitionSettings& settings)
{
  std::set<std::pair<double, double>> layers;
  for (const auto& sample : selected.samples.samples)
    layers.emplace(sample.key.bottom, sample.key.top);
  Json object{{"p", grid_of_layers.shares()}, {"layers", Json::array()}};
  for (const auto& layer : layers) {
    Json rows = Json::array();
    for (const auto& fit :
         scan_partition(of_layer(selected.samples, layer), grid_of_layers, settings.fit).fits)
      rows.push_back(b_with_interval(fit));
    object["layers"].push_back({{"bottom", layer.first}, {"B", std::move(rows)}});
  }
  return object;
}

/// The report that grseg-fit makes of these tables and rules.
FitReport report_of(const StressTables& input, const PartitionSettings& settings,
                    const Selected& selected)
{
  FitOptions options;
  for (const auto& rule : settings.rules) options.partition.push_back(rule.name());
  options.component = word_of(settings.fit.component, components);
  options.base = word_of(settings.fit.base, base_parts);
  const auto& [smaller, larger] = selected.samples.samples.front().pair;
  const auto& species = selected.samples.species;
  if (species.size() > 2) options.pair = species[smaller].name + ',' + species[larger].name;
  options.flows = "auto";
  options.filters = settings.filters;
  options.quiet = true;
  return make_report({"grseg-fit", "", "", ""}, options, "none", input.sums);
}

Json settings_object(const Selected& selected, const PartitionSettings& settings)
{
  const auto& filters = settings.filters;
  const auto& data = selected.samples;
  Json object{{"component", word_of(settings.fit.component, components)},
              {"base", word_of(settings.fit.base, base_parts)},
              {"ratio_range", fmt::format("{:g}:{:g}", filters.ratio_low, filters.ratio_high)},
              {"heights", heights_in_words(filters.heights, has_annuli(*selected.tables[0].table))},
              {"min_solid", format_number(filters.min_solid)},
              {"rows", data.count.sentence()},
              {"runs", fmt::format("{}", data.runs.size())},
              {"windows", fmt::format("{}", number_of_windows(data.runs))},
              {"window", fmt::format("{:g} s", data.window)}};
  const auto keys = listed(data.samples, &LayerSample::key);
  object["times"] =
      fmt::format("{:g} to {:g} s", std::ranges::min(keys, {}, &LayerKey::begin).begin,
                  std::ranges::max(keys, {}, &LayerKey::end).end);
  const auto& pair = data.samples.front().pair;
  if (data.species.size() > 2)
    object["pair"] = data.species[pair.smaller].name + ',' + data.species[pair.larger].name;
  return object;
}

}  // namespace

std::vector<double> power_nodes()
{
  constexpr int last = 15;
  std::vector<double> nodes;
  nodes.reserve(last + 1);
  for (int k = 0; k <= last; ++k)
    nodes.push_back(highest_power / 2 * (1 - std::cos(std::numbers::pi * k / last)));
  return nodes;
}

Json partition_data(const StressTables& input, const PartitionSettings& settings,
                    BinaryArrays& arrays)
{
  auto rules = settings.rules;
  for (const auto& given : given_rules) rules.push_back(given.rule);
  const auto selected = select(input.sums, rules, settings);
  const auto& pair = selected.samples.samples.front().pair;
  add_points(selected.samples, settings.fit, "", arrays);
  add_points(selected.layers, settings.fit, "layer_", arrays);
  const auto& species = selected.samples.species;
  const bool has_powers = species.size() == 2 && !input.of_powers.empty();
  if (has_powers) add_powers(input, settings, arrays);

  Json object{{"pair", {species[pair.smaller].name, species[pair.larger].name}},
              {"numbers_of_pair", {pair.smaller, pair.larger}},
              {"size_ratio", species[pair.larger].diameter / species[pair.smaller].diameter}};
  object["two"] = species.size() == 2;
  object["samples"] = selected.samples.samples.size();
  object["power_nodes"] = has_powers ? power_nodes() : std::vector<double>{};
  object["settings"] = settings_object(selected, settings);
  object["scan"] = scan_object(selected, settings);
  object["by_layer"] = layers_object(selected, settings);
  const auto report = report_of(input, settings, selected);
  object["rules"] = Json::array();
  for (const auto& fit : report.rules) object["rules"].push_back(rule_object(fit, report.flows));
  const auto over = report.rules.back().over;
  object["over"] = word_of(over, populations);
  for (const auto& [population, words] : estimands(report))
    if (population == over) object["over_words"] = words;
  object["verdict"] = report.verdict;
  object["doubts"] = report.doubts_of_tables;
  std::string of_zero;  // the same for every rule that has one; the last is of all flows
  for (const auto& fit : report.rules)
    if (std::isfinite(fit.line.p_zero.value)) of_zero = doubt_of_zero(fit.line.p_zero.estimate());
  if (!of_zero.empty()) object["doubts"].push_back(of_zero);
  return object;
}

}  // namespace grseg
