// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// How a run was made, /parameters in its file: numbers (SI) and texts by name.
///
/// Every run has the numbers gravity[2], step, frame_interval (in s), small_diameter and
/// large_diameter (nominal, never sample means), density, friction, restitution, seed; texts
/// `scene`, `program`, `command_line`, and `history`, one line per program that touched the data.
struct Parameters {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::string> texts;

  /// The value of `name`; FormatError naming `file` where it is absent or an array.
  double number(const std::string& name, const std::string& file) const;
  /// The one value of `name`, or nothing where it is absent or an array.
  std::optional<double> find_number(const std::string& name) const;
  /// The text of `name`, or "" where it is absent.
  std::string text(const std::string& name) const;
};

/// One number that is stored with every frame under /observables.
struct Observable {
  std::string name;
  std::string unit;  // H5MD style, e.g. "kg m s-1"; "" for a pure number
};

}  // namespace grseg
