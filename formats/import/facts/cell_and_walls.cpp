// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/cell_and_walls.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/species.hpp"
#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

ToldCell parse_cell(const std::string& text)
{
  const auto parts = parts_of(text, ':');
  ToldCell cell;
  cell.periodic = parts.size() == 4 && parts[3] == "periodic";
  const auto axis = parts.empty() || parts[0].size() != 1 ? std::string_view::npos
                                                          : std::string_view("xyz").find(parts[0]);
  if ((parts.size() != 3 && !cell.periodic) || axis == std::string_view::npos ||
      !parse_finite(parts[1], cell.low) || !parse_finite(parts[2], cell.high) ||
      !(cell.low < cell.high))
    throw UsageError(fmt::format(
        "--cell {}: write AXIS:LOW:HIGH in the archive's axes and units, as in x:0:0.4, or "
        "x:0:0.4:periodic",
        in_quotes(text)));
  cell.axis = static_cast<int>(axis);
  return cell;
}

WallPlane parse_wall(const std::string& text)
{
  const auto equals = text.find('='), colon = text.find(':', equals);
  const auto refuse = [&](const char* why) {
    throw UsageError(fmt::format(
        "--wall {}: {}; write NAME=AXIS:POSITION in the archive's axes and units, as in floor=z:0 "
        "or left=x:-10. Cylinders, cones and inclined planes are not imported from their names",
        in_quotes(text), why));
  };
  if (equals == std::string::npos || colon == std::string::npos)
    refuse("this is not a name, an axis and a position");
  WallPlane wall;
  wall.name = text.substr(0, equals);
  if (!is_species_name(wall.name)) refuse("a name has 1 to 15 of the characters A-Z a-z 0-9 _ - .");
  const auto axis = text.substr(equals + 1, colon - equals - 1);
  const auto place = std::string("xyz").find(axis);
  if (axis.size() != 1 || place == std::string::npos) refuse("the axis is not x, y or z");
  wall.axis = static_cast<int>(place);
  if (!parse_finite(text.substr(colon + 1), wall.position)) refuse("the position is not a number");
  return wall;
}

}  // namespace

std::string ToldCell::text() const
{
  return fmt::format("{}:{:.6g}:{:.6g}{}", "xyz"[axis], low, high, periodic ? ":periodic" : "");
}

std::vector<ToldCell> parse_cells(const std::vector<std::string>& texts)
{
  std::vector<ToldCell> cells;
  for (const auto& text : texts) {
    cells.push_back(parse_cell(text));
    for (std::size_t k = 0; k + 1 < cells.size(); ++k)
      if (cells[k].axis == cells.back().axis)
        throw UsageError(fmt::format("--cell is given twice along {}", "xyz"[cells[k].axis]));
  }
  return cells;
}

void tell(const ToldCell& cell, ArchiveFrame& frame)
{
  const auto axis = static_cast<std::size_t>(cell.axis);
  const double low = frame.low[cell.axis], high = frame.high[cell.axis];
  const double digits = 1e-6 * (high - low);
  const bool differs =
      !cell.periodic || std::abs(cell.low - low) > digits || std::abs(cell.high - high) > digits;
  if (frame.periodic[axis] && differs)
    throw UsageError(fmt::format("--cell {}, but the archive states {}: leave the option out",
                                 cell.text(), ToldCell{cell.axis, low, high, true}.text()));
  frame.low[cell.axis] = cell.low;
  frame.high[cell.axis] = cell.high;
  frame.periodic[axis] = cell.periodic;
  frame.cell[axis] = CellSource::told;
}

std::string WallPlane::place() const
{
  return fmt::format("{} = {:g}", "xyz"[axis], position);
}

std::vector<WallPlane> parse_walls(const std::vector<std::string>& texts)
{
  std::vector<WallPlane> walls;
  for (const auto& text : texts) {
    const auto wall = parse_wall(text);
    for (const auto& other : walls)
      if (other.name == wall.name || (other.axis == wall.axis && other.position == wall.position))
        throw UsageError(fmt::format(
            "--wall names {} ({}) and {} ({}): each wall needs its own name and position",
            other.name, other.place(), wall.name, wall.place()));
    walls.push_back(wall);
  }
  return walls;
}

std::optional<std::pair<double, double>> between_walls(const std::vector<WallPlane>& walls,
                                                       int axis)
{
  std::vector<double> places;
  for (const auto& wall : walls)
    if (wall.axis == axis) places.push_back(wall.position);
  if (places.size() < 2) return std::nullopt;
  const auto [low, high] = std::minmax_element(places.begin(), places.end());
  return std::pair(*low, *high);
}

std::string list_of(const std::vector<WallPlane>& walls)
{
  std::string text;
  for (const auto& wall : walls)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", wall.name, wall.place());
  return text;
}

}  // namespace grseg
