// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/height_range.hpp"
#include "formats/cli/table.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace grseg {

/// What every row by layer and window begins with, and what rows of different tools join on.
struct LayerKey {
  double begin = 0, end = 0;   // s, of the window
  double bottom = 0, top = 0;  // m, of the layer; NaN: the whole bed
  double frames = 0;
  double volume = 0;  // m^2, voids included
};

struct KeyColumn {
  const char* name;
  const char* unit;
  double LayerKey::*value;
};
/// The first columns of every such table.
inline constexpr std::array<KeyColumn, 6> key_columns{{{"t0", "[s]", &LayerKey::begin},
                                                       {"t1", "[s]", &LayerKey::end},
                                                       {"y0", "[m]", &LayerKey::bottom},
                                                       {"y1", "[m]", &LayerKey::top},
                                                       {"frames", "", &LayerKey::frames},
                                                       {"V", "[m^2]", &LayerKey::volume}}};

/// Names with units, followed by `more`.
std::vector<std::string> with_key_columns(const std::vector<std::string>& more);
/// A row: the key, followed by `more`.
std::vector<double> with_key(const LayerKey& key, const std::vector<double>& more);

/// Reads the keys of a table's rows. FormatError, adding `remedy`, where a column is missing, and
/// where time, frames or volume are not finite numbers. Heights may be NaN.
class LayerKeyReader {
 public:
  LayerKeyReader(const Table& table, const std::string& remedy);
  LayerKey read(std::size_t row) const;

 private:
  const Table& table_;
  std::array<std::size_t, key_columns.size()> columns_{};
};

/// Column number; FormatError that adds `remedy` ("make it with ...") where there is none.
std::size_t find_column(const Table& table, const std::string& name, const std::string& remedy);
/// A cell that must be a finite number; FormatError naming row and column where it is not.
double finite_cell(const Table& table, std::size_t row, std::size_t column);

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
