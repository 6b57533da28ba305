// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/composition.hpp"
#include "analysis/frames/layer_key.hpp"
#include "analysis/micro/structure_sums.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"

#include <string>
#include <vector>

namespace grseg {

/// The table of sums that grseg-micro writes, read again by grseg-derive.

/// A row of the table, or several merged; y0 = y1 = NaN for the whole bed and where different
/// layers were merged.
template <int D>
struct SumsRow : LayerKey {
  StructureSums<D> sums;
  BedHeights heights;  // means per frame; NaN in layers
  double bed_height;   // m, of the whole bed in the same window

  bool is_bed() const { return heights.bed == heights.bed; }
};

/// Constants of the run, from the header of the table.
struct RunConstants {
  double small_diameter, large_diameter;  // m, nominal
  double gravity_x, gravity_y;            // m/s^2
  double density, friction;               // kg/m^2 or kg/m^3, and 1; NaN where unknown
  double gravity_z = 0;                   // m/s^2, in three dimensions
  double mean_density = density;          // of all grains; `density` is of the small grains
};

/// Diameters are of the two species, or with --group of the two groups. FormatError where a line is
/// missing or its value is not a number; density and friction may be "unknown".
RunConstants read_run_constants(const Table& table);
/// FormatError, naming the place, where a column is missing or a number is not finite that must be.
template <int D>
std::vector<SumsRow<D>> read_sums_rows(const Table& table);

/// The rows in windows and layers that take part, however solid the layers are.
template <int D>
std::vector<SumsRow<D>> filtered(std::vector<SumsRow<D>> rows, const RowFilter& filter,
                                 LengthUnits units);

/// Which rows are merged.
enum class Pool {
  none,
  windows,      ///< each layer, and the whole bed, over all windows and tables
  composition,  ///< layers of all windows and tables by phi_L, in ten bins of equal width
};
/// Means weighted by frames. With `composition` the whole bed's rows and empty layers are left out.
template <int D>
std::vector<SumsRow<D>> pooled(const std::vector<SumsRow<D>>& rows, Pool pool);

/// Options of grseg-derive, as given on the command line.
struct DerivedOptions {
  std::string force = "modulus", average = "contacts", partition = "size", pool = "none", depth;
  RowFilter rows{.heights = ""};  // "": by `pool`

  /// Adds --force --average --partition --pool --depth --heights --begin --end.
  void add_to(po::options_description& options);
  /// UsageError where a word is unknown, before any table is read.
  void check() const;
};

/// The quantities that follow from tables of grseg-micro (derived_quantities.hpp), with
/// `provenance` as the first lines of its header and the settings of the first table behind it.
/// UsageError where options have no meaning or tables of different grains are given together;
/// RunError where no row is left.
Table derived_table(const std::vector<Table>& tables, const DerivedOptions& options,
                    const Header& provenance);

}  // namespace grseg
