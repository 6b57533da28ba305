// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/output.hpp"
#include "formats/export/map_table.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Whether a name asks for a map as other programs open it:
///   .h5   HDF5 for h5py, xarray and netCDF: a dataset [time][y][x] for each column, with its unit
///         in the attribute `units` and dimension scales time (middle of the window), y and x
///         (middles of the cells); t0, t1, frames [time], V [y][x], x_edges, y_edges; the lines of
///         the header as attributes of the file
///   .vti  VTK image data for ParaView: an array of cells for each column; of one window
///   .pvd  the same of all windows: a list of times and files, which lie in a folder beside it,
///         named like it without .pvd
bool is_map_file(const std::string& path);

/// Before work begins: UsageError where `path` cannot be what is made of `inputs`.
void check_map_file(const OutputOptions& output, const std::vector<std::string>& inputs);

/// Writes the table of a map, whole or not at all. UsageError where a .vti file would have to hold
/// several windows, RunError where the system refuses.
void write_map_file(const Table& table, const OutputOptions& output,
                    const std::vector<std::string>& inputs);

/// The content of a .vti file: one window of a map.
std::string image_data(const MapTable& map, std::size_t window);
/// Writes an HDF5 file as above.
void write_map_hdf5(const MapTable& map, const std::string& path, const std::string& name);

}  // namespace grseg
