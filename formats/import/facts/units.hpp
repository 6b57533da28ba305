// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <string>

namespace grseg {

/// The archive's units in SI. The unit of mass is in kg, also in two dimensions.
struct Units {
  double length = 1, time = 1, mass = 1;  // m, s, kg

  double velocity() const { return length / time; }
  double acceleration() const { return length / (time * time); }
  double force() const { return mass * acceleration(); }

  /// Converts from the archive's units to SI.
  void convert(Frame<3>& frame) const;
  void convert(Grains& grains) const;
};

inline constexpr Choice<Units> unit_words[] = {{"si", {}},
                                               {"cgs", {.length = 0.01, .time = 1, .mass = 0.001}}};
/// Reads units: "si", "cgs", or LENGTH:TIME:MASS in SI, as in 0.005:0.02259:2.5e-5, which
/// dimensionless units (lj) need. Throws UsageError for other text.
Units parse_units(const std::string& text);

}  // namespace grseg
