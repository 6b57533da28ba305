// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Parameters of a run (group /parameters of its file): numbers (SI) and texts by name.
///
/// Every run has the numbers gravity[2], step, frame_interval (s), small_diameter, large_diameter
/// (nominal, never sample means), density, friction, restitution and seed. Its texts are `scene`,
/// `program`, `command_line` and `history`, which has one line per program that touched the data.
struct Parameters {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::string> texts;

  /// The value of `name`. Throws FormatError, which names `file`, if it is absent or an array.
  double number(const std::string& name, const std::string& file) const;
  /// The value of `name`; empty if it is absent or an array.
  std::optional<double> find_number(const std::string& name) const;
  /// The text of `name`; "" if it is absent.
  std::string text(const std::string& name) const;
};

/// One number that is stored with every frame under /observables.
struct Observable {
  std::string name;
  std::string unit;  // H5MD style, e.g. "kg m s-1"; "" for a pure number
};

}  // namespace grseg
