// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <string>

namespace grseg {

/// SI units that one of the archive's own is: mass in kg, of a two-dimensional flow too.
struct Units {
  double length = 1, time = 1, mass = 1;  // m, s, kg

  double velocity() const { return length / time; }
  double acceleration() const { return length / (time * time); }
  double force() const { return mass * acceleration(); }

  /// Frame and grains in the archive's units become SI.
  void convert(Frame& frame) const;
  void convert(Grains& grains) const;
};

/// "si", "cgs", or LENGTH:TIME:MASS in SI, as in 0.005:0.02259:2.5e-5, which a program's units
/// without dimension (lj) need. UsageError otherwise.
Units parse_units(const std::string& text);

}  // namespace grseg
