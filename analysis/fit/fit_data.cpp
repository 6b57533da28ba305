// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/fit_data.hpp"

#include "analysis/frames/layer_key.hpp"
#include "analysis/stress/contact_sums_reader.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

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
  const auto column = [&](const char* name) {
    return find_column(table, name, "--quantity kinetic needs a table of grseg-kinetic");
  };
  return [&table, volume = column("V"), mass_small = column("mass_S"),
          mass_large = column("mass_L"), small_xx = column("K_S_xx"), small_yy = column("K_S_yy"),
          large_xx = column("K_L_xx"), large_yy = column("K_L_yy")](std::size_t row) {
    ContactSums sums;
    sums.volume = finite_cell(table, row, volume);
    sums.area_small = finite_cell(table, row, mass_small);
    sums.area_large = finite_cell(table, row, mass_large);
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

  const LayerKeyReader keys(table, "a table of grseg-stress or grseg-kinetic has it");
  const auto bottom = table.column("y0");
  std::vector<Row> rows;
  rows.reserve(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    finite_cell(table, row, bottom);  // these tables have no row for the whole bed
    rows.push_back({keys.read(row), sums(row)});
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
  const double small_diameter = table.header_number("small_diameter");
  const double large_diameter = table.header_number("large_diameter");
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

  for (const auto& row : rows) {
    const double small = row.sums.area_small, large = row.sums.area_large;
    const double rarer = std::min(small / (small_diameter * small_diameter),
                                  large / (large_diameter * large_diameter));
    data.samples.push_back({.window = window_at.at(row.key.begin),
                            .phi_large = large / (small + large),
                            .weight = row.key.frames * rarer,
                            .size_ratio = large_diameter / small_diameter,
                            .sums = row.sums});
  }
}

void refuse_twice_the_same(const Table& a, const Table& b)
{
  const auto inputs = header_values(a, "input");
  if (inputs.empty() || inputs != header_values(b, "input")) return;
  std::set<double> times;
  for (const auto& row : a.rows) times.insert(row[a.column("t0")]);
  for (const auto& row : b.rows)
    if (times.contains(row[b.column("t0")]))
      throw UsageError(
          fmt::format("{} and {} hold the same windows of the same run; counting them twice would "
                      "make intervals too narrow",
                      a.name, b.name));
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
  for (std::size_t k = 0; k < tables.size(); ++k) {
    add_run(tables[k], read_rows(tables[k], quantity, rules), filters, data);
    for (std::size_t earlier = 0; earlier < k; ++earlier)
      refuse_twice_the_same(tables[earlier], tables[k]);
  }
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
