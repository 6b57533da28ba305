// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/wall_planes.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/species.hpp"
#include "formats/import/common/text_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace grseg {
namespace {

WallPlane parse(const std::string& text)
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
  const char *from = text.data() + colon + 1, *to = text.data() + text.size();
  const auto [end, error] = std::from_chars(from, to, wall.position);
  if (error != std::errc() || end != to || !std::isfinite(wall.position))
    refuse("the position is not a number");
  return wall;
}

}  // namespace

std::string WallPlane::place() const
{
  return fmt::format("{} = {:g}", "xyz"[axis], position);
}

std::vector<WallPlane> parse_walls(const std::vector<std::string>& texts)
{
  std::vector<WallPlane> walls;
  for (const auto& text : texts) {
    const auto wall = parse(text);
    for (const auto& other : walls)
      if (other.name == wall.name || (other.axis == wall.axis && other.position == wall.position))
        throw UsageError(fmt::format(
            "--wall names {} ({}) and {} ({}): each wall has a name and a place of its own",
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
