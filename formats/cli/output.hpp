// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/tool.hpp"
#include "formats/core/files.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// Adds --overwrite, which has one meaning in all programs.
void add_overwrite_to(po::options_description& options, bool& overwrite);

/// What the command line says about where a table goes.
struct OutputOptions {
  std::string path;  ///< "" or "-": standard output
  bool overwrite = false;

  bool is_standard_output() const { return path.empty() || path == "-"; }
  /// Adds --output, with `help`, and --overwrite.
  void add_to(po::options_description& options, const char* help = "instead of standard output");
  /// Before work begins: UsageError where the file is one of the inputs that `values` name, a
  /// folder, or exists and --overwrite is not given. Devices and pipes are written to.
  void check(const po::variables_map& values) const;
};

/// A file that appears whole or not at all: it is written under a temporary name and renamed by
/// `publish`; without that it is removed.
class Output {
 public:
  /// UsageError where `path` cannot be what is made of `inputs` (check_output()).
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

/// Writes `text` to where `output` says, whole or not at all; devices and pipes are written to
/// directly. RunError on failure, and where a file has appeared that may not be replaced.
void write_whole(const OutputOptions& output, std::string_view text);

}  // namespace grseg
