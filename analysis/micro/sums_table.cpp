// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/sums_table.hpp"

#include "analysis/frames/layer_table.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

namespace grseg {
namespace {

double number_or_unknown(const Table& table, const std::string& key)
{
  return table.header_text(key) == "unknown" ? no_number : table.header_number(key);
}

/// Windows of one run differ in their beginning.
template <int D>
void set_bed_heights(std::vector<SumsRow<D>>& rows)
{
  std::map<double, double> height_at;
  for (const auto& row : rows)
    if (row.is_bed()) height_at[row.begin] = row.heights.bed;
  for (auto& row : rows) {
    const auto found = height_at.find(row.begin);
    row.bed_height = found == height_at.end() ? no_number : found->second;
  }
}

enum class SumKind { any, not_negative, may_be_nan };

struct SumColumn {
  std::optional<std::size_t> column;  // none: not kept
  SumKind kind;
};

SumKind kind_of(const std::string& name)
{
  const auto begins = [&](const char* word) { return name.starts_with(word); };
  if (begins("n_slide")) return SumKind::may_be_nan;  // without friction
  if (begins("area_") || begins("volume_") || begins("grains_") || begins("ends_") || begins("n_"))
    return SumKind::not_negative;
  return SumKind::any;
}

double value_of(const Table& table, std::size_t row, const SumColumn& sum)
{
  if (!sum.column) return no_number;
  if (sum.kind == SumKind::may_be_nan) return table.rows[row][*sum.column];
  constexpr double round_off = 1e-15;  // m^2 or m^3, of areas and volumes
  return sum.kind == SumKind::any ? finite_cell(table, row, *sum.column)
                                  : non_negative_cell(table, row, *sum.column, round_off);
}

}  // namespace

RunConstants read_run_constants(const Table& table)
{
  const auto species = species_of(table);
  if (species.size() != 2)
    throw FormatError(fmt::format("{}: grseg-derive compares two species, and the table has {}",
                                  table.name, species.size()));
  const bool densities_differ = table.has_header("mean_density");
  return {.small_diameter = species[0].diameter,
          .large_diameter = species[1].diameter,
          .gravity_x = table.header_number("gravity_x"),
          .gravity_y = table.header_number("gravity_y"),
          .density = number_or_unknown(table, densities_differ ? "density_S" : "density"),
          .friction = number_or_unknown(table, "friction"),
          .gravity_z = dimension_of(table) == 3 ? table.header_number("gravity_z") : 0,
          .mean_density = number_or_unknown(table, densities_differ ? "mean_density" : "density")};
}

template <int D>
std::vector<SumsRow<D>> read_sums_rows(const Table& table)
{
  const char* remedy = "grseg-derive needs a table of grseg-micro";
  std::vector<SumColumn> sums;
  for (const auto& name : columns_of(StructureSums<D>{}.cells()))
    sums.push_back({find_kept_column(table, name, remedy), kind_of(name)});
  const auto keys = read_layer_keys(table, remedy);
  std::vector<std::size_t> of_heights;
  for (const auto& name : columns_of(cells(BedHeights{})))
    of_heights.push_back(find_column(table, name, remedy));

  std::vector<SumsRow<D>> rows;
  rows.reserve(table.rows.size());
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto& numbers = table.rows[r];
    const auto& key = keys[r];
    std::vector<double> values;
    values.reserve(sums.size());
    for (const auto& sum : sums) values.push_back(value_of(table, r, sum));
    rows.push_back(
        {.begin = key.begin,
         .end = key.end,
         .bottom = key.bottom,
         .top = key.top,
         .frames = key.frames,
         .volume = key.volume,
         .sums = StructureSums<D>::from_values(values),
         .heights = {numbers[of_heights[0]], numbers[of_heights[1]], numbers[of_heights[2]]},
         .bed_height = no_number});
  }
  set_bed_heights(rows);
  return rows;
}

template std::vector<SumsRow<2>> read_sums_rows(const Table&);
template std::vector<SumsRow<3>> read_sums_rows(const Table&);

namespace {

/// Up to round-off: 1.4 d_S of 5 mm are 7 mm, but for the last bits.
template <int D>
bool same_layer(const SumsRow<D>& a, const SumsRow<D>& b)
{
  const double round_off = 1e-9 * (a.top - a.bottom);
  return std::abs(a.bottom - b.bottom) <= round_off && std::abs(a.top - b.top) <= round_off;
}

/// The sums behind a mean weighted by frames.
template <int D>
class MergedRow {
 public:
  void add(const SumsRow<D>& row)
  {
    const double w = row.frames;
    all_.frames += w;
    all_.volume += w * row.volume;
    all_.sums += row.sums * w;
    all_.heights.large += w * row.heights.large;
    all_.heights.small += w * row.heights.small;
    all_.heights.bed += w * row.heights.bed;
    all_.bed_height += w * row.bed_height;
    all_.begin = std::min(all_.begin, row.begin);
    all_.end = std::max(all_.end, row.end);
    if (rows_ == 0) {
      all_.bottom = row.bottom;
      all_.top = row.top;
    } else if (!same_layer(row, all_)) {
      all_.bottom = all_.top = no_number;
    }
    ++rows_;
  }

  SumsRow<D> mean() const
  {
    SumsRow<D> row = all_;
    const double frames = all_.frames;
    row.volume /= frames;
    row.sums = all_.sums / frames;
    row.heights = {all_.heights.large / frames, all_.heights.small / frames,
                   all_.heights.bed / frames};
    row.bed_height /= frames;
    return row;
  }

 private:
  std::size_t rows_ = 0;
  SumsRow<D> all_{.begin = std::numeric_limits<double>::infinity(),
                  .end = -std::numeric_limits<double>::infinity(),
                  .bottom = no_number,
                  .top = no_number,
                  .frames = 0,
                  .volume = 0,
                  .sums = {},
                  .heights = {0, 0, 0},
                  .bed_height = 0};
};

/// Rows with the same key are merged; the whole bed has its own, after all layers.
template <int D>
double pool_key(const SumsRow<D>& row, Pool pool)
{
  if (pool == Pool::composition) return std::min(std::floor(10 * row.sums.phi_large()), 9.0);
  // The number of the layer, which round-off does not change.
  return row.is_bed() ? std::numeric_limits<double>::infinity()
                      : std::round(row.bottom / (row.top - row.bottom));
}

}  // namespace

template <int D>
std::vector<SumsRow<D>> filtered(std::vector<SumsRow<D>> rows, const RowFilter& filter,
                                 LengthUnits units)
{
  std::vector<LayerSolid> layers;
  for (const auto& row : rows)
    if (!row.is_bed())
      layers.push_back({row.bottom, row.top, row.frames, row.sums.content() / row.volume});
  const auto heights = parse_heights(filter.heights, units, layers);
  std::erase_if(rows, [&](const SumsRow<D>& row) {
    const double time_slack = 1e-9 * (1 + std::abs(row.begin) + std::abs(row.end));
    return row.begin < filter.begin - time_slack || row.end > filter.end + time_slack ||
           !heights.holds(row.bottom, row.top);
  });
  return rows;
}

template <int D>
std::vector<SumsRow<D>> pooled(const std::vector<SumsRow<D>>& rows, Pool pool)
{
  if (pool == Pool::none) return rows;
  std::map<double, MergedRow<D>> merged;
  for (const auto& row : rows) {
    if (pool == Pool::composition && (row.is_bed() || std::isnan(row.sums.phi_large()))) continue;
    merged[pool_key(row, pool)].add(row);
  }
  std::vector<SumsRow<D>> result;
  result.reserve(merged.size());
  for (const auto& [key, row] : merged) result.push_back(row.mean());
  return result;
}

template std::vector<SumsRow<2>> filtered(std::vector<SumsRow<2>>, const RowFilter&, LengthUnits);
template std::vector<SumsRow<3>> filtered(std::vector<SumsRow<3>>, const RowFilter&, LengthUnits);
template std::vector<SumsRow<2>> pooled(const std::vector<SumsRow<2>>&, Pool);
template std::vector<SumsRow<3>> pooled(const std::vector<SumsRow<3>>&, Pool);

}  // namespace grseg
