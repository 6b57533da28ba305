// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/wall_contacts.hpp"

#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <unordered_map>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void append(ArchiveContacts& contacts, std::int64_t grain, std::int32_t wall, const Vec3& force,
            const Vec3& branch)
{
  const auto before = contacts.size();
  contacts.wall.resize(before, -1);
  contacts.branch.resize(before, Vec3::Constant(nan));
  contacts.i.push_back(grain);
  contacts.j.push_back(grain);
  contacts.wall.push_back(wall);
  contacts.force.push_back(force);
  contacts.branch.push_back(branch);
  for (auto* stated : {&contacts.overlap, &contacts.distance})
    if (!stated->empty()) stated->push_back(nan);
}

/// The name of a wall, "floor" from "f_floor[1]"; "" for other names.
std::string wall_of(const std::string& column)
{
  constexpr std::string_view first = "[1]";
  if (!column.starts_with("f_") || !column.ends_with(first)) return "";
  return column.substr(2, column.size() - 2 - first.size());
}

std::size_t first_column(const std::string& word, const DumpHeader& header)
{
  if (const auto named = header.find(word)) return *named;
  const auto number = number_of(word);
  if (number > 0 && number + 7 <= header.columns.size()) return number - 1;
  throw UsageError(
      fmt::format("--wall-columns: {} is not the first of eight "
                  "columns of {}, which has the columns {}",
                  in_quotes(word), header.place, fmt::join(header.columns, " ")));
}

const ColumnWords& row_words()
{
  static const ColumnWords words{
      "--wall-columns",
      "id=9,force=10,point=1,centre=4",
      {"id", "fx", "fy", "fz", "px", "py", "pz", "x", "y", "z", "mesh", "triangle"},
      {{"force", 1}, {"point", 4}, {"centre", 7}}};
  return words;
}
enum Word { id, fx, px = 4, x = 7, mesh = 10, triangle = 11 };

}  // namespace

void WallColumns::look_up(const DumpHeader& grains)
{
  walls_.clear();
  wanted_.clear();
  const auto take = [&](const std::string& wall, std::size_t first) {
    walls_.push_back(wall);
    for (std::size_t k = 0; k < 8; ++k) wanted_.push_back(first + k);
  };
  if (text_ == "none") return;
  for (const auto& part : parts_of(text_, ',')) {
    const auto equals = part.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError(fmt::format(
          "--wall-columns: {} is not of the form NAME=COLUMN, with the first of the eight columns "
          "of fix wall/gran, as in floor=f_floor[1]",
          in_quotes(part)));
    take(part.substr(0, equals), first_column(part.substr(equals + 1), grains));
  }
  if (!text_.empty()) return;
  for (std::size_t c = 0; c + 7 < grains.columns.size(); ++c) {
    const auto wall = wall_of(grains.columns[c]);
    bool all_there = !wall.empty();
    for (std::size_t k = 1; all_there && k < 8; ++k)
      all_there = grains.columns[c + k] == fmt::format("f_{}[{}]", wall, k + 1);
    if (all_there) take(wall, c);
  }
}

void WallColumns::add_to(ArchiveFrame& frame, const DumpGrains& columns) const
{
  const auto& grains = frame.grains;
  for (std::size_t wall = 0; wall < walls_.size(); ++wall)
    for (std::size_t g = 0; g < grains.size(); ++g) {
      std::array<double, 8> v;
      for (std::size_t k = 0; k < 8; ++k) v[k] = columns.more(8 * wall + k)[g];
      if (v[0] == 0) continue;
      const Vec3 force{v[1], v[2], v[3]}, point{v[4], v[5], v[6]};
      const Vec3 branch = frame.minimum_image(grains.position[g] - point);
      const double radius = grains.radius.empty() ? v[7] : grains.radius[g];
      if (v[0] != 1 || std::abs(v[7] - radius) > 1e-4 * radius || branch.norm() > 2 * radius)
        throw FormatError(fmt::format(
            "{}: the eight columns of wall {} are {:g} for grain {}, which are not flag, force, "
            "contact point and radius of `fix wall/gran ... contacts`; pass --wall-columns none if "
            "these columns have another meaning",
            frame.place, walls_[wall], fmt::join(v, " "), grains.id[g]));
      append(frame.contacts, grains.id[g], static_cast<std::int32_t>(wall), force, branch);
    }
}

WallRows::WallRows(const std::string& mapping) : map_(row_words(), mapping)
{
  if (!map_.has(id) || !map_.has(fx) || !map_.has(px))
    throw UsageError(fmt::format(
        "--wall-columns '{}' does not name the columns of id, force and point, as in {}", mapping,
        row_words().example));
}

void WallRows::read(JoinedDumps& dump, ArchiveFrame& frame)
{
  const auto header = dump.header();
  map_.look_up(header.columns, header.place);
  dump.read_rows(map_.wanted(), values_);
  const auto of = [&](std::size_t word) -> const std::vector<double>& {
    return map_.of(word, values_);
  };
  const auto triple = [&](std::size_t first, std::size_t row) {
    Vec3 values = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      if (!of(first + k).empty()) values[static_cast<Eigen::Index>(k)] = of(first + k)[row];
    return values;
  };
  const auto place = rows_by_id(frame.grains);
  std::unordered_map<std::int64_t, std::int32_t> rows_of;
  for (std::size_t row = 0; row < header.rows; ++row) {
    const auto grain = is_whole(of(id)[row]) ? static_cast<std::int64_t>(of(id)[row]) : -1;
    const auto found = place.find(grain);
    if (found == place.end())
      throw FormatError(fmt::format(
          "{}: {:g} in the column of id is not among the grains of step {}; set the meaning of the "
          "columns with --wall-columns",
          header.place, of(id)[row], header.step));
    const Vec3 centre = of(x).empty() ? frame.grains.position[found->second] : triple(x, row);
    std::int32_t wall = rows_of[grain]++;
    if (!of(triangle).empty()) {
      const double number = (of(mesh).empty() ? 0 : of(mesh)[row]) * 1e6 + of(triangle)[row];
      if (!(number >= 0 && number < 2e9))
        throw FormatError(
            fmt::format("{}: {:g} is not the number of a wall; set the meaning of the columns "
                        "with --wall-columns",
                        header.place, number));
      wall = static_cast<std::int32_t>(number);
    }
    append(frame.contacts, grain, wall, triple(fx, row),
           frame.minimum_image(centre - triple(px, row)));
  }
}

}  // namespace grseg
