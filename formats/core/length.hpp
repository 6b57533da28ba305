// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// Nominal diameters (m) in which lengths may be given; 0: unknown.
struct LengthUnits {
  double small_diameter = 0;
  double large_diameter = 0;
};

/// Metres from "20mm", "2cm", "0.02m", "4dS", "35dL" or "0", as a user writes them. UsageError with
/// `option`'s name and the accepted units where the text is not a length, and where a number has no
/// unit: 4 may be meant as four diameters.
double parse_length(const std::string& text, const std::string& option, LengthUnits units);

}  // namespace grseg
