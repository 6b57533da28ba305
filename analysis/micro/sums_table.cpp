// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/sums_table.hpp"

#include "analysis/frames/layer_key.hpp"

#include <limits>
#include <map>
#include <string>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double number_or_unknown(const Table& table, const std::string& key)
{
  return table.header_text(key) == "unknown" ? nan : table.header_number(key);
}

/// Windows of one run differ in their beginning.
void set_bed_heights(std::vector<SumsRow>& rows)
{
  std::map<double, double> height_at;
  for (const auto& row : rows)
    if (row.is_bed()) height_at[row.begin] = row.heights.bed;
  for (auto& row : rows) {
    const auto found = height_at.find(row.begin);
    row.bed_height = found == height_at.end() ? nan : found->second;
  }
}

}  // namespace

RunConstants read_run_constants(const Table& table)
{
  return {.small_diameter = table.header_number("small_diameter"),
          .large_diameter = table.header_number("large_diameter"),
          .gravity_x = table.header_number("gravity_x"),
          .gravity_y = table.header_number("gravity_y"),
          .density = number_or_unknown(table, "density"),
          .friction = number_or_unknown(table, "friction")};
}

std::vector<SumsRow> read_sums_rows(const Table& table)
{
  const char* remedy = "--derived needs a table of grseg-micro";
  const auto column = [&](const std::string& name) {
    return find_column(table, name.substr(0, name.find('[')), remedy);
  };
  struct Place {
    std::size_t column;
    bool may_be_nan;
  };
  std::vector<Place> sums;
  for (const auto& name : columns_of(StructureSums{}.cells()))
    sums.push_back({column(name), name.starts_with("n_slide")});  // NaN without friction
  const LayerKeyReader keys(table, remedy);
  const auto large = column("yL"), small = column("yS"), bed = column("height");

  std::vector<SumsRow> rows;
  rows.reserve(table.rows.size());
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto& cells = table.rows[r];
    const auto key = keys.read(r);
    std::vector<double> values;
    values.reserve(sums.size());
    for (const auto& [place, may_be_nan] : sums)
      values.push_back(may_be_nan ? cells[place] : finite_cell(table, r, place));
    rows.push_back({.begin = key.begin,
                    .end = key.end,
                    .bottom = key.bottom,
                    .top = key.top,
                    .frames = key.frames,
                    .volume = key.volume,
                    .sums = StructureSums::from_values(values),
                    .heights = {cells[large], cells[small], cells[bed]},
                    .bed_height = nan});
  }
  set_bed_heights(rows);
  return rows;
}

}  // namespace grseg
