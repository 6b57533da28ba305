// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// What a file says of how it was made, /parameters: numbers (SI) and texts by name.
///
/// Names every run carries: gravity[2], step, frame_interval (in s), small_diameter and
/// large_diameter (nominal, never sample means), density, friction, restitution, seed; texts
/// `scene`, `program`, `command_line`, and `history`, one line per program that touched the data.
struct Parameters {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::string> texts;

  /// The one value of `name`; FormatError naming `file` where it is absent or has several.
  double number(const std::string& name, const std::string& file) const;
  /// The one value of `name`, or nothing where it is absent or has several.
  std::optional<double> find_number(const std::string& name) const;
  /// The text of `name`, or "" where there is none.
  std::string text(const std::string& name) const;
};

/// One number that is stored with every frame under /observables.
struct Observable {
  std::string name;
  std::string unit;  // H5MD style, e.g. "kg m s-1"; "" for a pure number
};

}  // namespace grseg
