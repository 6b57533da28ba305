// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/frame_loop.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// A table for sums of `loop`, without rows. Its columns are the key columns, then `columns`. Its
/// header has program, preset, history, digest of the run, verification, numbers that later tools
/// need ("unknown" if the run lacks density, friction or restitution), and `settings` of the tool,
/// which replace values of the run. Throws UsageError if one window needs more memory than is free.
Table empty_table(const FrameLoop& loop, const std::string& command, const Header& settings,
                  const std::vector<std::string>& columns);
/// Numbers of a row: the key columns of a layer (t0 t1 y0 y1 frames V) or cell, then `values`.
std::vector<double> table_row(const FrameLoop& loop, const Window& window, std::size_t layer,
                              const std::vector<double>& values);

/// The table that a tool makes of a run. If it has many rows, they are written at intervals and
/// removed, so that a table of any size needs little memory. Rows for JSON, short tables and files
/// of maps remain in memory.
class TableWriter {
 public:
  /// Starts with empty_table().
  TableWriter(FrameLoop& loop, const std::string& command, const Header& settings,
              const std::vector<std::string>& columns);

  const Table& table() const { return table_; }
  /// Adds the row of a layer or cell.
  void add(const Window& window, std::size_t layer, const std::vector<double>& values)
  {
    add(table_row(loop_, window, layer, values));
  }
  /// Adds the row of the whole bed of a given height (m): y0 = y1 = nan, and V = Lx (Lz) times the
  /// height. V is nan if the bed's top is below y = 0, as in a hopper that runs empty.
  void add_bed(const Window& window, double height, const std::vector<double>& values);
  /// Writes the table to the file of --output, or to standard output; a map also as a file for
  /// other programs (formats/export/map_file.hpp). `next` is the command to suggest for this file,
  /// without the file's name: "grseg-fit".
  void write(const std::string& next = "");

 private:
  void add(std::vector<double> row);

  FrameLoop& loop_;
  Table table_;
  std::optional<GrowingTable> growing_;
};

}  // namespace grseg
