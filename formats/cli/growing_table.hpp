// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/output.hpp"
#include "formats/cli/table.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace grseg {

/// Text of a table that goes to its output while the table is made, so that some megabytes of its rows
/// are in memory. A file appears whole or not at all; what standard output has of a table that failed
/// lacks the line that ends it. Gives the same bytes as Table::to_text.
class GrowingTable {
 public:
  /// To where `output` says, which must not be a device.
  explicit GrowingTable(OutputOptions output);
  ~GrowingTable();

  /// True if `table` has so many rows that they should be written now.
  static bool is_large(const Table& table);
  /// Writes the rows of `table`, and before the first ones its header and columns; removes the rows.
  void add(Table& table);
  bool has_begun() const { return rows_ > 0; }
  /// Writes what is left and the line that ends the table.
  void finish(Table rest);

 private:
  struct Digest;
  void write(const std::string& text);

  OutputOptions output_;
  RemoveAtEnd temporary_;
  std::unique_ptr<Digest> digest_;
  std::size_t rows_ = 0;
};

}  // namespace grseg
