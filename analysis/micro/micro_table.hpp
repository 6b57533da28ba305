// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/micro/micro_sums.hpp"
#include "formats/cli/table.hpp"

#include <limits>
#include <string>
#include <vector>

namespace grseg {

/// A row of the table of grseg-micro, or several merged; y0 = y1 = NaN for the whole bed and where
/// different layers were merged.
struct MicroRow {
  double begin, end;   // s
  double bottom, top;  // m
  double frames;
  double volume;  // m^2
  MicroSums sums;
  BedHeights heights;  // NaN in layers
  double bed_height;   // m, of the whole bed in the same window

  bool is_bed() const { return heights.bed == heights.bed; }
};

/// What the header of the table says of the run.
struct MicroScale {
  double small_diameter, large_diameter;  // m, nominal
  double gravity_x, gravity_y;            // m/s^2
  double density, friction;               // kg/m^2; NaN where unknown
};

/// FormatError where a line is missing or is no number; "unknown" is allowed for density and
/// friction.
MicroScale read_micro_scale(const Table& table);
/// FormatError, naming the place, where a column is missing or a number is not finite that must be.
std::vector<MicroRow> read_micro_rows(const Table& table);

/// Which rows take part: windows in [begin, end], layers in [lowest, highest] (the whole bed's rows
/// always).
struct RowFilter {
  double begin = -std::numeric_limits<double>::infinity();  // s
  double end = std::numeric_limits<double>::infinity();
  double lowest = -std::numeric_limits<double>::infinity();  // m
  double highest = std::numeric_limits<double>::infinity();
};
std::vector<MicroRow> filtered(std::vector<MicroRow> rows, const RowFilter& filter);

enum class Pool {
  none,
  windows,      ///< each layer, and the whole bed, over all windows and tables
  composition,  ///< layers of all windows and tables by phi_L, in ten bins of equal width
};
/// Means weighted by frames. With `composition` the whole bed's rows and empty layers are left out.
std::vector<MicroRow> pooled(const std::vector<MicroRow>& rows, Pool pool);

}  // namespace grseg
