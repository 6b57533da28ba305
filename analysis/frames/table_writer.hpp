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

/// A table without rows of what `loop` sums: header with program, preset, history, content digest
/// of the run, what of it was verified, the numbers that later tools need ("unknown" where the run
/// does not have its density, friction or restitution) and `settings` of the tool, which stand for
/// what the run says of the same; key columns, then `columns`. UsageError where the sums of one
/// window need more memory than there is.
Table empty_table(const FrameLoop& loop, const std::string& command, const Header& settings,
                  const std::vector<std::string>& columns);
/// The key columns t0 t1 y0 y1 frames V of a layer, or the key columns of a cell, followed by
/// `values`.
std::vector<double> table_row(const FrameLoop& loop, const Window& window, std::size_t layer,
                              const std::vector<double>& values);

/// The table that a tool makes of a run. Where it has many rows, they are written and removed, so
/// that a table of any size needs little memory; JSON, files of maps and tables of parts keep
/// theirs.
class TableWriter {
 public:
  /// As empty_table.
  TableWriter(FrameLoop& loop, const std::string& command, const Header& settings,
              const std::vector<std::string>& columns);

  const Table& table() const { return table_; }
  /// Adds the row of a layer or cell.
  void add(const Window& window, std::size_t layer, const std::vector<double>& values)
  {
    add(table_row(loop_, window, layer, values));
  }
  /// Adds the row of the whole bed of a given height: y0 = y1 = nan, V = Lx (Lz) times the height,
  /// nan for a bed whose top lies below y = 0, as in a hopper that runs out.
  void add_bed(const Window& window, double height, const std::vector<double>& values);
  /// To the file of --output, or to standard output. A map may become a file for other programs
  /// (formats/export/map_file.hpp). `next` is what a reader of that file runs, without its name:
  /// "grseg-fit".
  void write(const std::string& next = "");

 private:
  void add(std::vector<double> row);
  /// The table with the rows of all parts.
  Table joined() const;

  FrameLoop& loop_;
  Table table_;
  std::optional<GrowingTable> growing_;
};

}  // namespace grseg
