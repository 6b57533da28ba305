// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/length.hpp"

#include <array>
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

/// The median solid fraction of the layers that are not empty; 0 where there are none.
double median_solid(const std::vector<LayerSolid>& layers);

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

/// What every row by layer and window begins with, and what rows of different tools join on.
struct LayerKey {
  double begin = 0, end = 0;   // s, of the window
  double bottom = 0, top = 0;  // m, of the layer; NaN: the whole bed
  double frames = 0;
  double volume = 0;  // m^2 or m^3, voids included
};

struct KeyColumn {
  const char* name;
  const char* unit;
  double LayerKey::*value;

  /// In 2 or 3 dimensions.
  std::string name_with_unit(int dimension) const;
};
/// The first columns of every such table.
inline constexpr std::array<KeyColumn, 6> key_columns{{{"t0", "[s]", &LayerKey::begin},
                                                       {"t1", "[s]", &LayerKey::end},
                                                       {"y0", "[m]", &LayerKey::bottom},
                                                       {"y1", "[m]", &LayerKey::top},
                                                       {"frames", "", &LayerKey::frames},
                                                       {"V", "[m^D]", &LayerKey::volume}}};
inline constexpr const KeyColumn& volume_column = key_columns.back();

/// "[m^2]" or "[m^3]".
const char* unit_of_volume(int dimension);
/// Names with units, followed by `more`.
std::vector<std::string> with_key_columns(int dimension, const std::vector<std::string>& more);
/// A row: the key, followed by `more`.
std::vector<double> with_key(const LayerKey& key, const std::vector<double>& more);

/// Rows that take part: windows between two times (s) and layers between two heights (m), up to
/// round-off. The whole bed lies between any heights.
struct RowRange {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
  HeightRange heights = {};

  bool holds_window(const LayerKey& key) const;
  bool holds_layer(const LayerKey& key) const { return heights.holds(key.bottom, key.top); }
};

}  // namespace grseg
