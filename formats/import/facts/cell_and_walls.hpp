// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Bounds of the cell along one of the archive's axes, in the archive's units: --cell x:0:0.4, or,
/// if the cell is periodic, --cell x:0:0.4:periodic.
struct ToldCell {
  int axis = 0;  // axis of the archive: 0, 1, 2
  double low = 0, high = 0;
  bool periodic = false;

  std::string text() const;  // text as of --cell: "x:0:0.4"
};

/// Reads all --cell options. Throws UsageError for another form, or if two name the same axis.
std::vector<ToldCell> parse_cells(const std::vector<std::string>& texts);

/// Sets the cell of a frame. Throws UsageError if the archive states another periodic cell.
void tell(const ToldCell& cell, ArchiveFrame& frame);

/// A plane wall normal to one of the archive's axes, in the archive's units: --wall floor=z:0.
struct WallPlane {
  std::string name;
  int axis = 0;  // axis of the archive: 0, 1, 2
  double position = 0;

  std::string place() const;  // text for messages: "z = 0"
};

/// Reads all --wall options. Throws UsageError if one does not have the form NAME=AXIS:POSITION, or
/// if two have the same name or position.
std::vector<WallPlane> parse_walls(const std::vector<std::string>& texts);

/// Lowest and highest position of walls normal to an axis; empty for fewer than two walls.
std::optional<std::pair<double, double>> between_walls(const std::vector<WallPlane>& walls,
                                                       int axis);

/// The walls as text for messages: "floor (z = 0), left (x = -10)".
std::string list_of(const std::vector<WallPlane>& walls);

}  // namespace grseg
