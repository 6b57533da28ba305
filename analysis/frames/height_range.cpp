// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/height_range.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

namespace grseg {

bool HeightRange::holds(double bottom, double top) const
{
  const double slack = 1e-9 * (top - bottom);
  return !(bottom < lowest - slack || top > highest + slack);
}

HeightRange parse_heights(const std::string& text, LengthUnits units)
{
  HeightRange range;
  if (text.empty()) return range;
  const auto colon = text.find(':');
  if (colon == std::string::npos)
    throw UsageError(fmt::format("--heights {}: write low:high, e.g. 4dS:56dS or 4dS:", text));
  const auto low = text.substr(0, colon), high = text.substr(colon + 1);
  if (!low.empty()) range.lowest = parse_length(low, "--heights", units);
  if (!high.empty()) range.highest = parse_length(high, "--heights", units);
  return range;
}

}  // namespace grseg
