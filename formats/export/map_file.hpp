// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/output.hpp"
#include "formats/cli/table.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// The table of a map taken apart: fields over windows and over a grid of cells, the same in all
/// windows. Rows of such a table begin with t0 t1, the edges of the cell along two axes (x0 x1 y0
/// y1), frames and V; they run along the first axis, then along the second, then over windows.
struct MapTable {
  struct Axis {
    std::string name;           // "x"
    std::vector<double> edges;  // m, increasing
    std::size_t cells() const { return edges.size() - 1; }
    double middle(std::size_t cell) const { return (edges[cell] + edges[cell + 1]) / 2; }
  };
  struct Window {
    double begin, end, frames;  // s, s, number
    double middle() const { return (begin + end) / 2; }
  };
  struct Field {
    std::string name, unit;
    std::vector<double> values;  // [window][second axis][first axis]
  };

  std::array<Axis, 2> axes;
  std::vector<Window> windows;
  Field volume;  // of one window
  std::vector<Field> fields;
  /// Lines of the table's header, each key once; several lines of one key are joined by ends of
  /// line.
  std::vector<std::pair<std::string, std::string>> header;

  std::size_t cells() const { return axes[0].cells() * axes[1].cells(); }
};

/// The columns that rows of a map begin with.
std::vector<std::string> map_key_columns(const std::array<std::string, 2>& axes, int dimension);

/// FormatError where the table is not of a map.
MapTable map_table(const Table& table);

/// True where a file name asks for a map in a format of other programs:
///   .h5   HDF5 for h5py, xarray and netCDF: a dataset [time][y][x] for each column, with its unit
///         in the attribute `units` and dimension scales time (middle of the window), y and x
///         (middles of the cells); t0, t1, frames [time], V [y][x], x_edges, y_edges; the lines of
///         the header as attributes of the file
///   .vti  VTK image data for ParaView: an array of cells for each column; one window
///   .pvd  such files for all windows: a list of times and files, which lie in a folder beside it,
///         named like it without .pvd
bool is_map_file(const std::string& path);

/// Before work begins: UsageError where `path` cannot be what is made of `inputs`.
void check_map_file(const OutputOptions& output, const std::vector<std::string>& inputs);

/// Writes the table of a map, whole or not at all. UsageError where a .vti file would have to hold
/// several windows, RunError where the system refuses.
void write_map_file(const Table& table, const OutputOptions& output,
                    const std::vector<std::string>& inputs);

/// Writes an HDF5 file as above.
void write_map_hdf5(const MapTable& map, const std::string& path, const std::string& name);

}  // namespace grseg
