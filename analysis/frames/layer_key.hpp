// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/map_grid.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"
#include "formats/core/length.hpp"
#include "formats/core/species.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Functions that read tables by layer and window, and refuse tables that cannot be right.

namespace grseg {

/// Range of heights, m, of the layers that an analysis uses: the option --heights.
struct HeightRange {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();

  /// True if a layer from `bottom` to `top` lies in the range, up to rounding. Always true for the
  /// whole bed, whose bottom and top are NaN.
  bool holds(double bottom, double top) const;
};

/// Default value of --heights in every tool that combines layers.
inline constexpr const char* inside_the_bed = "inside";
/// Distance of the layers `inside` from base and surface, in small diameters.
inline constexpr double margin_inside = 4;
/// Values of --heights, for --help.
inline constexpr const char* heights_help =
    "inside (without 4 dS at the base and 4 dS under the surface; of annuli: without 4 dS at the "
    "wall and, off the axis, at the surface), all, or y0:y1, e.g. 4dS:56dS or 4dS: (dS, dL: diameters of small and large grains)";
/// Description of a value of --heights for the header of a table, of layers or of annuli.
std::string heights_in_words(const std::string& text, bool annuli = false);

/// Throws UsageError if the text is not a value of --heights.
void check_heights(const std::string& text);

/// First columns of every row of a table by layer and window. Tables of different tools are joined
/// on them. In a map a "layer" is a cell: its edges along the second axis of the map are `bottom`
/// and `top`, those along the first axis `left` and `right`.
struct LayerKey {
  double begin = 0, end = 0;   // times of the window, s
  double bottom = 0, top = 0;  // heights of the layer's edges, m; NaN: the whole bed
  double frames = 0;           // number of frames in the window
  double volume = 0;           // volume of the layer with its voids, m^2 or m^3
  double left = 0, right = 0;  // m; both 0 unless the table is a map
};

/// A layer or cell in one window, or averaged over several.
struct LayerSolid {
  LayerKey key;
  double solid = 0;  // area, volume or mass of the grains over the layer's volume
};

/// The median solid fraction of the layers that are not empty; 0 if all are empty.
double median_solid(const std::vector<LayerSolid>& layers);
/// Each layer with its mean solid fraction over the frames of all windows, from the lowest upward.
std::vector<LayerSolid> mean_layers(const std::vector<LayerSolid>& layers);

/// The range of heights that a value of --heights selects in a bed of these layers. "inside" is the
/// range from 4 d_S above the base to 4 d_S below the surface. The base is the bottom of the lowest
/// layer with at least half the median solid fraction, averaged over windows. The surface is the
/// top of a bed with the same grains and the median solid fraction everywhere. "inside" leaves out
/// the base, because a large grain there touches only fixed grains, and the surface, because few
/// grains collide there: their stress is not shared as in the bed.
HeightRange parse_heights(const std::string& text, LengthUnits units,
                          const std::vector<LayerSolid>& layers);

struct KeyColumn {
  const char* name;
  const char* unit;
  double LayerKey::*value;

  /// Name of the column with its unit, for 2 or 3 dimensions.
  std::string name_with_unit(int dimension) const;
};
/// The columns of LayerKey in the order of tables.
inline constexpr std::array<KeyColumn, 6> key_columns{{{"t0", "[s]", &LayerKey::begin},
                                                       {"t1", "[s]", &LayerKey::end},
                                                       {"y0", "[m]", &LayerKey::bottom},
                                                       {"y1", "[m]", &LayerKey::top},
                                                       {"frames", "", &LayerKey::frames},
                                                       {"V", "[m^D]", &LayerKey::volume}}};
inline constexpr const KeyColumn& volume_column = key_columns.back();

/// "[m^2]" in two dimensions, "[m^3]" in three.
const char* unit_of_volume(int dimension);
/// Names of the key columns with units, followed by `more`.
std::vector<std::string> with_key_columns(int dimension, const std::vector<std::string>& more);
/// Numbers of a row: the key, followed by `more`.
std::vector<double> with_key(const LayerKey& key, const std::vector<double>& more);

/// Rows of one bed that an analysis uses: windows between two times (s) and layers between two
/// heights (m), up to round-off. Rows of the whole bed are in every range of heights.
struct RowRange {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
  HeightRange heights = {};
  double least_solid = 0;  // least solid fraction of a layer

  bool holds_window(const LayerKey& key) const;
  bool holds_layer(const LayerKey& key) const { return heights.holds(key.bottom, key.top); }
};

/// Options of a tool that select the rows of tables to use.
struct RowFilter {
  double begin = -std::numeric_limits<double>::infinity();  // earliest time of a window, s
  double end = std::numeric_limits<double>::infinity();     // latest time of a window, s
  std::string heights = "all";                              // value of --heights
  double min_solid = 0.5;  // least solid fraction of a layer over the median of its bed

  /// Adds --begin and --end.
  void add_times_to(po::options_description& options);
  /// Adds --heights, by default `inside`, and --min-solid. Their help text begins with `when`.
  void add_layers_to(po::options_description& options, const std::string& when = "");
  /// Throws UsageError if a value is invalid.
  void check() const;
  /// Header lines "heights" and "min_solid".
  Header lines() const;
  /// True for windows between `begin` and `end`.
  bool holds_window(const LayerKey& key) const { return RowRange{begin, end}.holds_window(key); }
  /// The layers in windows between `begin` and `end`. Base, surface and median solid fraction of a
  /// bed are of these.
  std::vector<LayerSolid> in_times(std::vector<LayerSolid> layers) const;
  /// The rows to use of a bed that has these layers, of all windows.
  RowRange range(LengthUnits units, const std::vector<LayerSolid>& layers) const;
};

/// Dimension of the run of a table: its header line "dimension", or 2 without this line. Throws
/// FormatError for any other number than 2 or 3.
int dimension_of(const Table& table);
/// The mobile species of a table: its header line "species", or else small and large with the
/// diameters in the header. Throws FormatError if the line cannot be read.
SpeciesList species_of(const Table& table);

/// First header lines of a table that a tool makes from other tables (provenance.hpp): program,
/// preset if the tool has presets, histories of all tables, `command`, inputs, and verification.
Header provenance_of(const std::vector<Table>& tables, const ToolInfo& info,
                     const std::string& preset, const std::string& command);
/// The plane of a map (header line "bins"); nothing for tables by layer or annulus.
std::optional<MapPlane> plane_of(const Table& table);
/// True if the rows of a table are annuli, whose "heights" are distances from an axis.
bool has_annuli(const Table& table);
/// Throws FormatError if a table is a map, which has rows of cells.
void refuse_map(const Table& table);

/// The keys of all rows of a table by layer, or of a map. Throws FormatError if a column is missing
/// (the message ends with `remedy`), or if a length or time in the header is not positive. Also,
/// with the numbers of the rows, if a time, number of frames or volume is impossible (the whole bed
/// may be empty), if a layer or cell is repeated in a window, or if windows, layers or cells
/// overlap.
std::vector<LayerKey> read_keys(const Table& table, const std::string& remedy);
/// read_keys(), for what has no meaning for cells: throws FormatError if the table is a map.
std::vector<LayerKey> read_layer_keys(const Table& table, const std::string& remedy);

/// Column number of `name`, which includes the unit as grseg writes it, "V[m^2]". Throws
/// FormatError if the column is missing (the message ends with `remedy`, "make it with ...") or has
/// another unit. Only tables made by hand may leave units out.
std::size_t find_column(const Table& table, const std::string& name, const std::string& remedy);
/// find_column(), or nothing if the table's header line "not kept" names the column.
std::optional<std::size_t> find_kept_column(const Table& table, const std::string& name,
                                            const std::string& remedy);
/// The element of `written` that is `name` followed by a unit.
const std::string& with_unit(const std::string& name, const std::vector<std::string>& written);

/// Number in a cell. Throws FormatError, with row and column, unless it is finite.
double finite_cell(const Table& table, std::size_t row, std::size_t column);
/// finite_cell(), which also throws if the number is less than -round_off.
double non_negative_cell(const Table& table, std::size_t row, std::size_t column,
                         double round_off = 0);

}  // namespace grseg
