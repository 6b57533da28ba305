// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/micro_table.hpp"

#include "analysis/frames/layer_key.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double number_or_unknown(const Table& table, const std::string& key)
{
  return table.header_text(key) == "unknown" ? nan : table.header_number(key);
}

/// Windows of one run are told apart by their beginning.
void set_bed_heights(std::vector<MicroRow>& rows)
{
  std::map<double, double> height_at;
  for (const auto& row : rows)
    if (row.is_bed()) height_at[row.begin] = row.heights.bed;
  for (auto& row : rows) {
    const auto found = height_at.find(row.begin);
    row.bed_height = found == height_at.end() ? nan : found->second;
  }
}

/// Sums that a mean weighted by frames is made of.
class MergedRow {
 public:
  void add(const MicroRow& row)
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
    const bool same = rows_ == 0 || (row.bottom == all_.bottom && row.top == all_.top);
    all_.bottom = same ? row.bottom : nan;
    all_.top = same ? row.top : nan;
    ++rows_;
  }

  MicroRow mean() const
  {
    MicroRow row = all_;
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
  MicroRow all_{.begin = std::numeric_limits<double>::infinity(),
                .end = -std::numeric_limits<double>::infinity(),
                .bottom = nan,
                .top = nan,
                .frames = 0,
                .volume = 0,
                .sums = {},
                .heights = {0, 0, 0},
                .bed_height = 0};
};

/// Rows with the same key become one; the whole bed has its own, behind all layers.
double pool_key(const MicroRow& row, Pool pool)
{
  if (pool == Pool::composition) return std::min(std::floor(10 * row.sums.phi_large()), 9.0);
  return row.is_bed() ? std::numeric_limits<double>::infinity() : row.bottom;
}

}  // namespace

MicroScale read_micro_scale(const Table& table)
{
  return {.small_diameter = table.header_number("small_diameter"),
          .large_diameter = table.header_number("large_diameter"),
          .gravity_x = table.header_number("gravity_x"),
          .gravity_y = table.header_number("gravity_y"),
          .density = number_or_unknown(table, "density"),
          .friction = number_or_unknown(table, "friction")};
}

std::vector<MicroRow> read_micro_rows(const Table& table)
{
  const std::string remedy = "--derived needs a table of grseg-micro";
  const auto column = [&](const std::string& name) { return find_column(table, name, remedy); };
  std::vector<std::size_t> places, may_lack;
  for (const auto& name : MicroSums::columns()) {
    places.push_back(column(name.substr(0, name.find('['))));
    if (name.starts_with("n_slide")) may_lack.push_back(places.back());
  }
  const auto begin = column("t0"), end = column("t1"), bottom = column("y0"), top = column("y1"),
             frames = column("frames"), volume = column("V"), large = column("yL"),
             small = column("yS"), bed = column("height");

  std::vector<MicroRow> rows;
  rows.reserve(table.rows.size());
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto& cells = table.rows[r];
    std::vector<double> numbers;
    numbers.reserve(places.size());
    for (const auto place : places)
      numbers.push_back(std::find(may_lack.begin(), may_lack.end(), place) == may_lack.end()
                            ? finite_cell(table, r, place)
                            : cells[place]);
    rows.push_back({.begin = finite_cell(table, r, begin),
                    .end = finite_cell(table, r, end),
                    .bottom = cells[bottom],
                    .top = cells[top],
                    .frames = finite_cell(table, r, frames),
                    .volume = finite_cell(table, r, volume),
                    .sums = MicroSums::from_numbers(numbers),
                    .heights = {cells[large], cells[small], cells[bed]},
                    .bed_height = nan});
  }
  set_bed_heights(rows);
  return rows;
}

std::vector<MicroRow> filtered(std::vector<MicroRow> rows, const RowFilter& filter)
{
  std::erase_if(rows, [&](const MicroRow& row) {
    const double time_slack = 1e-9 * (1 + std::abs(row.begin) + std::abs(row.end));
    const double slack = 1e-9 * (row.top - row.bottom);
    return row.begin < filter.begin - time_slack || row.end > filter.end + time_slack ||
           row.bottom < filter.lowest - slack || row.top > filter.highest + slack;
  });
  return rows;
}

std::vector<MicroRow> pooled(const std::vector<MicroRow>& rows, Pool pool)
{
  if (pool == Pool::none) return rows;
  std::map<double, MergedRow> merged;
  for (const auto& row : rows) {
    if (pool == Pool::composition && (row.is_bed() || std::isnan(row.sums.phi_large()))) continue;
    merged[pool_key(row, pool)].add(row);
  }
  std::vector<MicroRow> result;
  result.reserve(merged.size());
  for (const auto& [key, row] : merged) result.push_back(row.mean());
  return result;
}

}  // namespace grseg
