// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/height_range.hpp"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace grseg {

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
