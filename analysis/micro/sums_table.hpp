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

/// Functions by which grseg-derive reads and merges tables of grseg-micro.

/// A row of the table, or several merged rows. y0 = y1 = NaN for the whole bed, and if different
/// layers were merged.
template <int D>
struct SumsRow : LayerKey {
  StructureSums<D> sums;
  BedHeights heights;  // mean heights over frames, m; NaN in rows of layers
  double bed_height;   // height of the whole bed in the same window, m

  bool is_bed() const { return heights.bed == heights.bed; }
};

/// Constants of the run, from the header of the table.
struct RunConstants {
  double small_diameter, large_diameter;  // nominal diameters, m
  double gravity_x, gravity_y;            // components of gravity, m/s^2
  double density, friction;               // density of small grains, kg/m^D; NaN if unknown
  double gravity_z = 0;                   // component in three dimensions, m/s^2
  double mean_density = density;          // density of all grains, kg/m^2 or kg/m^3
};

/// Constants from the header of a table. With --group they have the diameters of the two groups.
/// Throws FormatError unless each is a number; only density and friction may be "unknown".
RunConstants read_run_constants(const Table& table);
/// The rows of a table. Throws FormatError, with the place, if a column is missing or a number is
/// not finite; some columns may be NaN.
template <int D>
std::vector<SumsRow<D>> read_sums_rows(const Table& table);

/// The rows in windows and layers that the filter selects, for any solid fraction of layers.
template <int D>
std::vector<SumsRow<D>> filtered(std::vector<SumsRow<D>> rows, const RowFilter& filter,
                                 LengthUnits units);

/// Rows that are merged into one.
enum class Pool {
  none,
  windows,      ///< all windows and tables, separately for each layer and for the whole bed
  composition,  ///< one row per tenth of phi_L, from the layers of all windows and tables
};
/// One row for all rows that `pool` puts together: their means, weighted by frames. `composition`
/// leaves out empty layers and the row of the whole bed.
template <int D>
std::vector<SumsRow<D>> pooled(const std::vector<SumsRow<D>>& rows, Pool pool);

/// Options of grseg-derive.
struct DerivedOptions {
  std::string force = "modulus", average = "contacts", partition = "size", pool = "none", depth;
  RowFilter rows{.heights = ""};  // heights = "": the default depends on `pool`

  /// Adds --force --average --partition --pool --depth --heights --begin --end.
  void add_to(po::options_description& options);
  /// Throws UsageError if a word is unknown, before any table is read.
  void check() const;
};

/// Table of the quantities that follow from tables of grseg-micro (derived_quantities.hpp). Its
/// header has the lines `provenance`, then the settings of the first table. Throws UsageError if an
/// option is invalid or if the tables have different grains, and RunError if no row remains.
Table derived_table(const std::vector<Table>& tables, const DerivedOptions& options,
                    const Header& provenance);

}  // namespace grseg
