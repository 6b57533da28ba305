// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/layer_key.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"
#include "formats/core/species.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// Reading tables by layer and window, and refusing those that cannot be true.
namespace grseg {

/// 2, or the number in the line "dimension". FormatError where that is not 3.
int dimension_of(const Table& table);
/// The mobile species that a table is about: those of its line "species", or small and large with
/// the diameters of the header. FormatError where they are not to be understood.
SpeciesList species_of(const Table& table);

/// The first lines of a table that a tool makes of others (provenance.hpp): program, preset where the
/// tool has them, history of all with `command` as its last line, inputs, and what was verified.
Header provenance_of(const std::vector<Table>& tables, const ToolInfo& info,
                     const std::string& preset, const std::string& command);
/// FormatError where a table is a map, whose rows are not of layers.
void refuse_map(const Table& table);

/// The keys of all rows. FormatError for a map, and, adding `remedy`, where a column is missing; and, naming the
/// rows, where a time, number of frames or volume has no meaning (a bed of NaN heights may be
/// empty), where two rows are of the same layer in the same window, and where windows or the layers
/// of a window overlap; also where a length or time in the header is not positive.
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
