// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"
#include "formats/core/files.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// Adds --overwrite, which has one meaning in all programs.
void add_overwrite_to(po::options_description& options, bool& overwrite);

/// Destination of a table or file, as the command line gives it.
struct OutputOptions {
  std::string path;  ///< "" or "-": standard output
  bool overwrite = false;

  bool is_standard_output() const { return path.empty() || path == "-"; }
  /// Adds --output, with `help`, and --overwrite.
  void add_to(po::options_description& options, const char* help = "instead of standard output");
  /// Checks the file before work begins: UsageError where it is one of the inputs that `values`
  /// name, a folder, or exists and --overwrite is not given. Devices and pipes are written to.
  void check(const po::variables_map& values) const;
};

/// Destination of a table, and the form in which it is printed.
struct TableOptions : OutputOptions {
  bool short_form = false;
  int digits = 0;  ///< significant ones; 0: all in the whole table, few in the short one

  /// Adds --short, --digits, --output and --overwrite.
  void add_to(po::options_description& options);
  /// Also refuses a number of digits that cannot be, and either option beside --json.
  void check(const po::variables_map& values) const;
  /// True where a table for reading goes to standard output: it was asked for, or standard output
  /// is a terminal and no file is named.
  bool prints_short() const;
};

/// A file that appears whole or not at all: it is written under a temporary name and renamed by
/// `publish`; without that it is removed.
class Output {
 public:
  /// UsageError where `path` may not be an output of a program with these `inputs`
  /// (check_output()).
  Output(std::string path, bool overwrite, const std::vector<std::string>& inputs);

  const std::string& temporary() const { return temporary_.path(); }
  /// Everything must have been written and closed. RunError where the system refuses, or where a
  /// file of this name has appeared that may not be replaced.
  void publish() { publish_file(temporary(), path_, overwrite_); }

 private:
  std::string path_;
  bool overwrite_;
  RemoveAtEnd temporary_;
};

/// Writes `text` to the place that `output` names, whole or not at all; devices and pipes are
/// written to directly. RunError on failure, and where a file has appeared that may not be
/// replaced.
void write_whole(const OutputOptions& output, std::string_view text);

/// Writes the table `text` likewise. Where the short form is wanted it goes to standard output,
/// beside a file that is named: `short_text`, or else `text` made short. JSON, which begins with
/// "{", has no short form.
void write_table(const TableOptions& output, const std::string& text,
                 const std::string& short_text = "");

/// A table that is written while it is made, so that only some megabytes of its rows are in memory.
/// A file appears whole or not at all; a table that failed on standard output lacks the line that
/// ends it. It has the same bytes as Table::to_text.
class GrowingTable {
 public:
  /// The place that `output` names must not be a device.
  explicit GrowingTable(OutputOptions output);
  ~GrowingTable();

  /// True if `table` has so many rows that they should be written now.
  static bool is_large(const Table& table);
  /// Writes the rows of `table`, and before the first ones its header and columns; removes the
  /// rows.
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
