// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// Nominal diameters (m) that are the units dS and dL of lengths; 0: unknown.
struct LengthUnits {
  double small_diameter = 0;
  double large_diameter = 0;
};

/// Length (m) from text that a user typed: "20mm", "2cm", "0.02m", "4dS", "35dL" or "0". Throws
/// UsageError, which names `option` and the accepted units, if the text is not a length or if a
/// number has no unit (a plain 4 may mean four diameters).
double parse_length(const std::string& text, const std::string& option, LengthUnits units);

}  // namespace grseg
