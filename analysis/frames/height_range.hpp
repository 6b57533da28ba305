// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/length.hpp"

#include <limits>
#include <string>
#include <vector>

namespace grseg {

/// The heights, m, between which layers must lie to take part: the option --heights.
struct HeightRange {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();

  /// Whether a layer from `bottom` to `top` lies in the range, within rounding. True of the whole
  /// bed, whose bottom and top are NaN.
  bool holds(double bottom, double top) const;
};

/// A layer in one window, or in the mean of several.
struct LayerSolid {
  double bottom = 0, top = 0;  // m
  double frames = 0;           // its weight
  double solid = 0;            // area, volume or mass of its grains over its own
};

/// The word, which is the default of every tool that puts layers together.
inline constexpr const char* inside_the_bed = "inside";
/// For --help: what the option may be.
inline constexpr const char* heights_help =
    "inside (without 4 d_S at the base and 4 d_S under the surface), all, or y0:y1, e.g. 4dS:56dS or "
    "4dS:";
/// The same choice for the header of a table.
std::string heights_in_words(const std::string& text);

/// UsageError where the text is no such choice.
void check_heights(const std::string& text);

/// The range that --heights means for a bed of these layers. "inside": from 4 d_S above its lowest layer
/// to 4 d_S below its surface, where it would end if it were as solid everywhere as its median layer; the
/// lowest layer has in the mean at least half of that. A large grain at a base touches fixed ones alone,
/// and at the surface few grains fall on each other: what is shared there is not what the bed shares.
HeightRange parse_heights(const std::string& text, LengthUnits units,
                          const std::vector<LayerSolid>& layers);

}  // namespace grseg
