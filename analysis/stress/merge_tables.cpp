// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/merge_tables.hpp"

#include "analysis/frames/flow_of_table.hpp"
#include "analysis/frames/layer_key.hpp"
#include "analysis/frames/runs_of_tables.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>

namespace grseg {
namespace {

/// Begin and end of a window in whole steps, so that times of 3 * 0.1 s and 0.3 s are equal.
using Times = std::pair<std::int64_t, std::int64_t>;

/// Key and cells of a row.
struct Row : LayerKey {
  const std::vector<double>* cells;
};

/// One window of one table.
struct Part {
  const Table* table;
  double begin = 0, end = 0, frames = 0;
  std::map<std::int64_t, Row> layers;  // rows by number of the layer
};

/// The windows of one table.
using Parts = std::map<Times, Part>;

bool is_source(const std::string& key)
{
  return key == "history" || key == "input" || key == "bed" || key == "scene";
}

void require_stress_table(const Table& table)
{
  refuse_map(table);
  const int dimension = dimension_of(table);
  for (std::size_t c = 0; c < key_columns.size(); ++c)
    if (find_column(table, key_columns[c].name_with_unit(dimension),
                    "a table of grseg-stress has it") != c)
      throw FormatError(fmt::format("{}: column {} is '{}', but grseg-stress writes '{}' there",
                                    table.name, c + 1, table.columns[c], key_columns[c].name));
}

/// Throws FormatError if the settings of two tables differ, except windows with `all_windows`.
void require_same_settings(const Table& a, const Table& b, bool all_windows)
{
  const auto line = [](const auto& setting) {
    return fmt::format("'# {}: {}'", setting.first, setting.second);
  };
  const auto refuse = [&](const std::string& of_a, const std::string& of_b) {
    throw FormatError(
        fmt::format("{} and {} were made differently: {} and {}; only tables with the same layers, "
                    "windows and rules can be merged",
                    a.name, b.name, of_a, of_b));
  };
  const auto all_a = settings_of(a), all_b = settings_of(b);
  for (std::size_t k = 0; k < std::max(all_a.size(), all_b.size()); ++k) {
    if (k >= all_a.size()) refuse("nothing", line(all_b[k]));
    if (k >= all_b.size()) refuse(line(all_a[k]), "nothing");
    const bool same_key = all_a[k].first == all_b[k].first;
    if (same_key && all_windows && all_a[k].first == "window") continue;
    if (!same_key || !same_setting(all_a[k].second, all_b[k].second))
      refuse(line(all_a[k]), line(all_b[k]));
  }
  if (a.columns != b.columns)
    throw FormatError(fmt::format("{} and {} have different columns", a.name, b.name));
}

/// Rounded ratio of a number in a row to one in the header. Throws FormatError if it is too large.
std::int64_t nearest_whole(double ratio, const Table& table, std::size_t row)
{
  constexpr double most = 1e15;
  if (std::abs(ratio) > most)
    throw FormatError(fmt::format("{}: row {}: does not fit the step and layer in the header",
                                  table.name, row + 1));
  return std::llround(ratio);
}

Parts parts_of(const Table& table)
{
  const double step = table.header_positive("step"), thickness = table.header_positive("layer");
  const auto keys = read_layer_keys(table, "a table of grseg-stress has it");
  Parts parts;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    for (std::size_t column = 0; column < table.columns.size(); ++column)
      finite_cell(table, row, column);
    const LayerKey& key = keys[row];
    auto& part = parts[{nearest_whole(key.begin / step, table, row),
                        nearest_whole(key.end / step, table, row)}];
    if (part.layers.empty()) part = {&table, key.begin, key.end, key.frames, {}};
    if (key.frames != part.frames)
      throw FormatError(fmt::format("{}: row {}: {} frames, but other rows of its window have {}",
                                    table.name, row + 1, format_number(key.frames),
                                    format_number(part.frames)));
    const auto layer = nearest_whole(key.bottom / thickness, table, row);
    if (!part.layers.emplace(layer, Row{key, &table.rows[row]}).second)
      throw FormatError(fmt::format("{}: row {} repeats a window and layer", table.name, row + 1));
  }
  return parts;
}

/// Throws UsageError if two different windows overlap. Equal windows of several tables are merged.
void refuse_overlaps(const std::map<Times, std::vector<const Part*>>& windows)
{
  if (windows.empty()) return;
  for (auto before = windows.begin(), next = std::next(before); next != windows.end();
       before = next++) {
    const auto &a = *before->second[0], &b = *next->second[0];
    if (next->first.first < before->first.second)
      throw UsageError(fmt::format(
          "{} and {} have windows that partly overlap, from {:g} s and from {:g} s; make them with "
          "the same --begin and --window, or merge with --all-windows",
          a.table->name, b.table->name, a.begin, b.begin));
  }
}

/// Rows of a window: means over the parts, weighted by frames.
std::vector<std::vector<double>> merged_rows(const std::vector<const Part*>& parts)
{
  Part all{nullptr, parts[0]->begin, parts[0]->end, 0, {}};
  for (const auto* part : parts) {
    all.begin = std::min(all.begin, part->begin);
    all.end = std::max(all.end, part->end);
    all.frames += part->frames;
    all.layers.insert(part->layers.begin(), part->layers.end());
  }
  std::vector<std::vector<double>> rows;
  for (const auto& [layer, first] : all.layers) {
    std::vector<double> means(first.cells->size() - key_columns.size(), 0.0);
    for (const auto* part : parts) {
      const auto found = part->layers.find(layer);
      if (found == part->layers.end()) continue;
      for (std::size_t c = 0; c < means.size(); ++c)
        means[c] += part->frames / all.frames * (*found->second.cells)[key_columns.size() + c];
    }
    rows.push_back(
        with_key({all.begin, all.end, first.bottom, first.top, all.frames, first.volume}, means));
  }
  return rows;
}

}  // namespace

Table merge_tables(std::vector<Table> tables, bool all_windows, const ToolInfo& info,
                   const std::string& command)
{
  if (tables.empty()) throw UsageError("no tables given to merge; name some, e.g. a.tsv b.tsv");
  for (const auto& table : tables) {
    require_stress_table(table);
    require_same_settings(tables[0], table, all_windows);
  }
  // Sorted, so that the order of summation does not depend on the order of the arguments.
  std::ranges::stable_sort(tables, [](const Table& a, const Table& b) {
    return std::pair(header_values(a, "input"), a.to_text()) <
           std::pair(header_values(b, "input"), b.to_text());
  });

  const auto parts = listed(tables, parts_of);
  const auto runs = find_runs(tables);
  require_one_flow(tables, runs.run, FlowsApart::by_any);
  const auto doubt = runs.doubt(tables);
  std::map<Times, std::vector<const Part*>> windows;
  Times whole(std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min());
  for (const auto& of_table : parts)
    for (const auto& [window, part] : of_table) {
      windows[all_windows ? Times{} : window].push_back(&part);
      whole = {std::min(whole.first, window.first), std::max(whole.second, window.second)};
    }
  refuse_overlaps(windows);

  Table merged;
  merged.header.push_back(program_line(info));
  for (const auto& table : tables)
    for (const auto& line : table.header)
      if (is_source(line.first)) merged.header.push_back(line);
  merged.header.emplace_back("history", command);
  add_all(merged.header, trust_of(tables));
  if (!doubt.empty()) merged.header.emplace_back("doubt", doubt);
  add_all(merged.header, settings_of(tables[0]));
  merged.columns = tables[0].columns;
  for (const auto& [window, of_window] : windows) add_all(merged.rows, merged_rows(of_window));
  if (all_windows && !merged.rows.empty()) {
    // Subtracted in whole steps, because 2.2 - 2 is not exactly 0.2.
    const double length =
        static_cast<double>(whole.second - whole.first) * tables[0].header_positive("step");
    for (auto& [key, value] : merged.header)
      if (key == "window") value = format_number(length);
  }
  return merged;
}

}  // namespace grseg
