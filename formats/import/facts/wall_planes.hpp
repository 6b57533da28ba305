// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// A plane wall across one of the archive's axes, in the archive's units: --wall floor=z:0.
struct WallPlane {
  std::string name;
  int axis = 0;  // 0, 1, 2
  double position = 0;

  std::string place() const;  // "z = 0"
};

/// The walls of all --wall options. UsageError where one is not of the form NAME=AXIS:POSITION, or
/// where two have the same name or place.
std::vector<WallPlane> parse_walls(const std::vector<std::string>& texts);

/// The lowest and the highest place of walls across an axis; nothing where there are no two.
std::optional<std::pair<double, double>> between_walls(const std::vector<WallPlane>& walls,
                                                       int axis);

/// "floor (z = 0), left (x = -10)"
std::string list_of(const std::vector<WallPlane>& walls);

}  // namespace grseg
