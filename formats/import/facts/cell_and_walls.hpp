// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// The cell along one of the archive's axes, in the archive's units: --cell x:0:0.4 or, where grains
/// that leave at one end come back at the other, --cell x:0:0.4:periodic.
struct ToldCell {
  int axis = 0;  // 0, 1, 2
  double low = 0, high = 0;
  bool periodic = false;

  std::string text() const;  // "x:0:0.4"
};

/// The cells of all --cell options. UsageError where one is not of that form, or an axis is told
/// twice.
std::vector<ToldCell> parse_cells(const std::vector<std::string>& texts);

/// Gives a moment this cell. UsageError where the archive says that it is periodic otherwise.
void tell(const ToldCell& cell, ArchiveMoment& moment);

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
