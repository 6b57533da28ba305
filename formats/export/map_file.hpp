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

/// Content of a map table: fields over time windows and over one grid of cells for all windows. A
/// row of a map table begins with t0 t1, the edges of the cell along two axes (x0 x1 y0 y1), frames
/// and V. Rows run over the first axis fastest, then over the second axis, then over windows.
struct MapTable {
  struct Axis {
    std::string name;           // name of the axis: "x"
    std::vector<double> edges;  // edges of the cells, m, increasing
    std::size_t cells() const { return edges.size() - 1; }
    double middle(std::size_t cell) const { return (edges[cell] + edges[cell + 1]) / 2; }
  };
  struct Window {
    double begin, end, frames;  // begin and end (s), number of frames
    double middle() const { return (begin + end) / 2; }
  };
  struct Field {
    std::string name, unit;
    std::vector<double> values;  // in the order [window][second axis][first axis]
  };

  std::array<Axis, 2> axes;
  std::vector<Window> windows;
  Field volume;  // area or volume of each cell (column V); one window
  std::vector<Field> fields;
  /// Header lines of the table (key, value). Each key occurs once; values of repeated keys are
  /// joined by line ends.
  std::vector<std::pair<std::string, std::string>> header;

  std::size_t cells() const { return axes[0].cells() * axes[1].cells(); }
};

/// Names of the first columns of a map table: t0 to V.
std::vector<std::string> map_key_columns(const std::array<std::string, 2>& axes, int dimension);

/// Content of a map table. Throws FormatError if `table` is not the table of a map.
MapTable map_table(const Table& table);

/// True if the ending of a file name, .h5, asks for a map in HDF5, for h5py, xarray and netCDF: a
/// dataset [time][y][x] for each column, with its unit in the attribute `units` and dimension scales
/// time (middle of the window), y and x (middles of the cells); a column z beside a coordinate z is
/// z_all; t0, t1, frames [time], V [y][x], x_edges, y_edges; the header lines as attributes of the
/// file.
inline bool is_map_file(const std::string& path)
{
  return path.ends_with(".h5");
}

/// Writes the table of a map to such a file, whole or not at all. Throws RunError if the system
/// fails.
void write_map_file(const Table& table, const OutputOptions& output,
                    const std::vector<std::string>& inputs);

}  // namespace grseg
