// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/length.hpp"

#include <limits>
#include <string>

namespace grseg {

/// The heights, m, between which layers must lie to take part: the option --heights.
struct HeightRange {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();

  /// Whether a layer from `bottom` to `top` lies in the range, within rounding. True of the whole
  /// bed, whose bottom and top are NaN.
  bool holds(double bottom, double top) const;
};

/// The range that "4dS:56dS" or "4dS:" describes; all heights for an empty text. UsageError where
/// the colon is missing or a height is not a length.
HeightRange parse_heights(const std::string& text, LengthUnits units);

}  // namespace grseg
