// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"
#include "formats/core/files.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// Adds --overwrite, which means the same in all programs.
void add_overwrite_to(po::options_description& options, bool& overwrite);

/// Destination of a table or file, from the command line.
struct OutputOptions {
  std::string path;  ///< "" or "-": standard output
  bool overwrite = false;

  bool is_standard_output() const { return path.empty() || path == "-"; }
  /// Adds --output, with `help`, and --overwrite.
  void add_to(po::options_description& options, const char* help = "output file (default: stdout)");
  /// Checks the file before work begins. Throws UsageError if it is a folder, one of the inputs in
  /// `values`, or if it exists and --overwrite is not given. Accepts devices and pipes.
  void check(const po::variables_map& values) const;
};

/// Destination of a table, and the form in which the table is printed.
struct TableOptions : OutputOptions {
  bool short_form = false;
  int digits = 0;  ///< significant digits; 0: 17 in the whole table, fewer in the short one

  /// Adds --short, --digits, --output and --overwrite.
  void add_to(po::options_description& options);
  /// As OutputOptions::check(). Also throws UsageError if --digits is not 1 to 17, or if --short or
  /// --digits is combined with --json.
  void check(const po::variables_map& values) const;
  /// True if the short table goes to standard output: with --short, or if standard output is a
  /// terminal and no file is named.
  bool prints_short() const;
};

/// A file that appears whole or not at all. It is written under a temporary name, which publish()
/// changes to the final name. The destructor removes a file that was not published.
class Output {
 public:
  /// Throws the errors of check_output() if `path` may not be the output of a program with these
  /// `inputs`.
  Output(const std::string& path, bool overwrite, const std::vector<std::string>& inputs);

  const std::string& temporary() const { return temporary_.path(); }
  /// Call it after everything has been written and closed. Throws RunError if the system fails, or
  /// if a file of this name has appeared that may not be replaced.
  void publish() { publish_file(temporary(), path_, overwrite_); }

 private:
  std::string path_;
  bool overwrite_;
  RemoveAtEnd temporary_;
};

/// Writes `text` to `output`: to a file whole or not at all, to a device or pipe directly. Throws
/// RunError on failure, and if a file has appeared that may not be replaced.
void write_whole(const OutputOptions& output, std::string_view text);

/// Writes the table `text` like write_whole(). If the short form is wanted, also prints
/// `short_text` (or `text` shortened, if `short_text` is empty) to standard output; the whole table
/// is then written only if a file is named. JSON, which begins with "{", has no short form.
void write_table(const TableOptions& output, const std::string& text,
                 const std::string& short_text = "");

/// A table that is written while it is computed, so that only some megabytes of its rows are in
/// memory. It has the same bytes as Table::to_text. A file appears whole or not at all; a table on
/// standard output that was not finished lacks its last line (end_line()).
class GrowingTable {
 public:
  /// The destination `output` must not be a device.
  explicit GrowingTable(OutputOptions output);
  ~GrowingTable();

  /// True if `table` has so many rows that they should be written now.
  static bool is_large(const Table& table);
  /// Writes the rows of `table` and removes them from `table`. The first call writes header and
  /// column names before the rows.
  void add(Table& table);
  bool has_begun() const { return rows_ > 0; }
  /// Writes the rows of `rest` and the last line of the table (end_line()).
  void finish(Table rest);

 private:
  struct Digest;
  void write(const std::string& text);

  OutputOptions output_;
  std::optional<RemoveAtEnd> temporary_;  // none: standard output
  std::unique_ptr<Digest> digest_;
  std::size_t rows_ = 0;
};

}  // namespace grseg
