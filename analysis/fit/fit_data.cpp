// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_data.hpp"

#include "analysis/frames/distinct_runs.hpp"
#include "analysis/frames/layer_table.hpp"
#include "analysis/stress/contact_sums_reader.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

namespace grseg {
namespace {

/// One row before the filters.
struct Row {
  LayerKey key;
  ContactSums sums;

  double solid() const { return (sums.area_small + sums.area_large) / sums.volume; }
};

using SumsOfRow = std::function<ContactSums(std::size_t)>;

Tensor2 symmetric_part(const Table& table, std::size_t row, std::size_t xx, std::size_t yy)
{
  Tensor2 value = Tensor2::Zero();
  value(0, 0) = finite_cell(table, row, xx);
  value(1, 1) = finite_cell(table, row, yy);
  return value;
}

/// Kinetic sums as contact sums in which nothing is mixed; "areas" are masses.
SumsOfRow kinetic_sums(const Table& table)
{
  const auto column = [&table, written = KineticStress::columns()](const char* name) {
    return find_column(table, with_unit(name, written),
                       "--quantity kinetic needs a table of grseg-kinetic");
  };
  return [&table, mass_small = column("mass_S"), mass_large = column("mass_L"),
          small_xx = column("K_S_xx"), small_yy = column("K_S_yy"), large_xx = column("K_L_xx"),
          large_yy = column("K_L_yy")](std::size_t row) {
    ContactSums sums;
    sums.area_small = non_negative_cell(table, row, mass_small);
    sums.area_large = non_negative_cell(table, row, mass_large);
    sums.ss = symmetric_part(table, row, small_xx, small_yy);
    sums.ll = symmetric_part(table, row, large_xx, large_yy);
    return sums;
  };
}

std::vector<Row> read_rows(const Table& table, Quantity quantity,
                           const std::vector<PartitionRule>& rules)
{
  SumsOfRow sums;
  if (quantity == Quantity::kinetic)
    sums = kinetic_sums(table);
  else
    sums = [reader = ContactSumsReader(table, rules)](std::size_t row) { return reader.read(row); };

  const auto keys = read_layer_keys(table, "a table of grseg-stress or grseg-kinetic has it");
  const auto bottom = table.column("y0");
  std::vector<Row> rows;
  rows.reserve(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    finite_cell(table, row, bottom);  // these tables have no row for the whole bed
    rows.push_back({keys[row], sums(row)});
    rows.back().sums.volume = keys[row].volume;
  }
  return rows;
}

double median_solid_fraction(const std::vector<Row>& rows)
{
  std::vector<double> solid;
  for (const auto& row : rows)
    if (row.solid() > 0) solid.push_back(row.solid());
  return solid.empty() ? 0 : gsl_stats_median(solid.data(), 1, solid.size());
}

/// Counts a row under the reason why it is left out, or as used; true if it becomes a point.
bool passes(const Row& row, const FitFilters& filters, const RowRange& range, double median_solid,
            FilterCount& count)
{
  const double small = row.sums.area_small, large = row.sums.area_large;
  const double ratio = small / large;
  const auto goes_to = [](std::size_t& place) {
    ++place;
    return false;
  };
  ++count.rows;
  if (!range.holds_window(row.key)) return goes_to(count.outside_times);
  if (!range.holds_layer(row.key)) return goes_to(count.outside_heights);
  if (!(small + large > 0) || !(row.key.frames > 0)) return goes_to(count.without_grains);
  if (!(small > 0)) return goes_to(count.without_small);
  if (!(large > 0)) return goes_to(count.without_large);
  if (ratio < filters.ratio_low || ratio > filters.ratio_high) return goes_to(count.outside_ratio);
  if (row.solid() < filters.min_solid * median_solid) return goes_to(count.below_solid);
  ++count.used;
  return true;
}

void add_run(const Table& table, std::vector<Row> rows, const FitFilters& filters, FitData& data)
{
  const double small_diameter = table.header_positive("small_diameter");
  const double large_diameter = table.header_positive("large_diameter");
  const double median = median_solid_fraction(rows);
  const RowRange range{filters.begin, filters.end,
                       parse_heights(filters.heights, {small_diameter, large_diameter})};
  std::erase_if(rows,
                [&](const Row& row) { return !passes(row, filters, range, median, data.count); });

  std::map<double, std::size_t> window_at;
  for (const auto& row : rows) window_at[row.key.begin] = 0;
  std::size_t window = 0;
  for (const auto length : data.runs) window += length;
  for (auto& [time, number] : window_at) number = window++;
  if (!window_at.empty()) data.runs.push_back(window_at.size());

  data.tables.push_back(table.name);
  for (const auto& row : rows) {
    const double small = row.sums.area_small, large = row.sums.area_large;
    const double rarer = std::min(small / (small_diameter * small_diameter),
                                  large / (large_diameter * large_diameter));
    data.samples.push_back({.window = window_at.at(row.key.begin),
                            .phi_large = large / (small + large),
                            .weight = row.key.frames * rarer,
                            .size_ratio = large_diameter / small_diameter,
                            .table = data.tables.size() - 1,
                            .sums = row.sums});
  }
}

}  // namespace

std::string FilterCount::sentence() const
{
  std::string text = fmt::format("{} rows", rows);
  const auto add = [&](std::size_t n, const char* why) {
    if (n > 0) text += fmt::format(", {} {}", n, why);
  };
  add(outside_times, "outside --begin and --end");
  add(outside_heights, "outside --heights");
  add(without_grains, "without grains");
  add(without_small, "without small grains");
  add(without_large, "without large grains");
  add(outside_ratio, "outside --ratio-range");
  add(below_solid, "below --min-solid");
  return text;
}

FitData read_fit_data(const std::vector<Table>& tables, Quantity quantity,
                      const FitFilters& filters, const std::vector<PartitionRule>& rules)
{
  FitData data;
  data.quantity = quantity;
  for (const auto& table : tables) add_run(table, read_rows(table, quantity, rules), filters, data);
  require_distinct_runs(tables);
  if (data.samples.empty()) {
    const auto& count = data.count;
    const bool one_species = count.without_small + count.without_large > 0 &&
                             count.outside_ratio + count.below_solid == 0;
    throw RunError(fmt::format("no usable points: {}{}", count.sentence(),
                               one_species ? "; B needs layers that hold both species" : ""));
  }
  return data;
}

}  // namespace grseg
