// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

/// Reading tables by layer and window, and refusing tables that cannot be true.

namespace grseg {

/// The heights, m, between which layers must lie to take part: the option --heights.
struct HeightRange {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();

  /// True where a layer from `bottom` to `top` lies in the range, within rounding, and for the
  /// whole bed, whose bottom and top are NaN.
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
    "inside (without 4 dS at the base and 4 dS under the surface), all, or y0:y1, e.g. 4dS:56dS or "
    "4dS: (dS, dL: diameters of small and large grains)";
/// A choice of --heights in words for the header of a table.
std::string heights_in_words(const std::string& text);

/// UsageError where the text is no such choice.
void check_heights(const std::string& text);

/// The range that --heights means for a bed of these layers. "inside": from 4 d_S above its lowest
/// layer to 4 d_S below its surface, where it would end if it were as solid everywhere as its
/// median layer; the lowest layer has in the mean at least half of that. A large grain at a base
/// touches fixed ones alone, and at the surface few grains fall on each other: what is shared there
/// is not what the bed shares.
HeightRange parse_heights(const std::string& text, LengthUnits units,
                          const std::vector<LayerSolid>& layers);

/// First columns of every row by layer and window, on which rows of different tools join.
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

/// Rows of one bed that take part: windows between two times (s) and layers between two heights
/// (m), up to round-off. The whole bed lies between any heights.
struct RowRange {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
  HeightRange heights = {};
  double least_solid = 0;  // least solid fraction of a layer

  bool holds_window(const LayerKey& key) const;
  bool holds_layer(const LayerKey& key) const { return heights.holds(key.bottom, key.top); }
};

/// Rows that take part, as on the command line of a tool that reads or makes tables.
struct RowFilter {
  double begin = -std::numeric_limits<double>::infinity();  // s
  double end = std::numeric_limits<double>::infinity();
  std::string heights = "all";
  double min_solid = 0.5;  // least solid fraction of a layer over the median of its bed

  /// Adds --begin and --end.
  void add_times_to(po::options_description& options);
  /// Adds --heights, by default `inside`, and --min-solid; `when` begins their help.
  void add_layers_to(po::options_description& options, const std::string& when = "");
  /// UsageError where a value has no meaning.
  void check() const;
  /// Header lines "heights" and "min_solid".
  Header lines() const;
  /// The range of a bed of these layers.
  RowRange range(LengthUnits units, const std::vector<LayerSolid>& layers) const;
};

/// 2, or the number in the line "dimension". FormatError where that is not 3.
int dimension_of(const Table& table);
/// The mobile species that a table is about: from its line "species", or small and large with the
/// diameters of the header. FormatError where that line cannot be read.
SpeciesList species_of(const Table& table);

/// The first lines of a table that a tool makes of others (provenance.hpp): program, preset where
/// the tool has them, history of all with `command` as its last line, inputs, and what was
/// verified.
Header provenance_of(const std::vector<Table>& tables, const ToolInfo& info,
                     const std::string& preset, const std::string& command);
/// FormatError where a table is a map, whose rows are not of layers.
void refuse_map(const Table& table);

/// The keys of all rows. FormatError for a map, and, adding `remedy`, where a column is missing;
/// and, naming the rows, where a time, number of frames or volume has no meaning (a bed of NaN
/// heights may be empty), where two rows are of the same layer in the same window, and where
/// windows or the layers of a window overlap; also where a length or time in the header is not
/// positive.
std::vector<LayerKey> read_layer_keys(const Table& table, const std::string& remedy);

/// Column number of `name`, which is given with its unit as grseg writes it, "V[m^2]". FormatError
/// that adds `remedy` ("make it with ...") where there is none, and one that names both where its
/// unit is another; only tables made by hand may leave units out.
std::size_t find_column(const Table& table, const std::string& name, const std::string& remedy);
/// Nothing where the table's line "not kept" says that the column was left out.
std::optional<std::size_t> find_kept_column(const Table& table, const std::string& name,
                                            const std::string& remedy);
/// The name among `written` that is `name` with a unit.
const std::string& with_unit(const std::string& name, const std::vector<std::string>& written);

/// A cell that must be a finite number; FormatError naming row and column where it is not.
double finite_cell(const Table& table, std::size_t row, std::size_t column);
/// Also where it is less than 0 by more than `round_off`.
double non_negative_cell(const Table& table, std::size_t row, std::size_t column,
                         double round_off = 0);

}  // namespace grseg
