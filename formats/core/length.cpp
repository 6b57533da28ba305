// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/length.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace grseg {

double parse_length(const std::string& text, const std::string& option, LengthUnits units)
{
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  double factor = 0;
  if (unit == "m" || (unit.empty() && number == 0)) factor = 1;
  if (unit == "mm") factor = 1e-3;
  if (unit == "cm") factor = 1e-2;
  if (unit == "dS") factor = units.small_diameter;
  if (unit == "dL") factor = units.large_diameter;
  if (unit.empty() && end != text.c_str() && std::isfinite(number) && number != 0)
    throw UsageError(units.small_diameter > 0
                         ? fmt::format("{0} {1} has no unit: {1}dS, {1}dL or {1}m?", option, text)
                         : fmt::format("{0} {1} has no unit: {1}m or {1}mm?", option, text));
  if (end == text.c_str() || factor <= 0 || !std::isfinite(number))
    throw UsageError(
        fmt::format("{} '{}' is not a length: give a number with a unit, as in 0.02m, 20mm{}",
                    option, text, units.small_diameter > 0 ? ", 4dS, 2dL" : ""));
  return number * factor;
}

}  // namespace grseg
