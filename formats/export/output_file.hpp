// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/output.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// A file that is written piece by piece and appears whole or not at all. It is compressed by gzip
/// if its name ends in .gz, without a time in its header: the same content gives the same bytes.
class OutputFile {
 public:
  /// Throws the errors of check_output() if `path` may not be the output of a program with these
  /// `inputs`, RunError if the file cannot be created.
  OutputFile(const std::string& path, bool overwrite, const std::vector<std::string>& inputs);
  ~OutputFile();

  /// Throws RunError if the system fails.
  void write(std::string_view bytes);
  /// Passes the last bytes to the system; throws RunError if that fails. If several files belong
  /// together, close all of them before publishing the first.
  void close();
  void publish();

 private:
  struct Packer;
  std::string name_;
  Output output_;
  std::unique_ptr<Packer> packer_;  // compression stream; null for a file without compression
};

/// A folder of files that appears whole or not at all.
class OutputFolder {
 public:
  /// `mark` is a file by which the folder of an earlier export is recognised. Throws UsageError if
  /// `path` is a folder without this file or contains one of `inputs`, even with `overwrite`.
  OutputFolder(std::string path, std::string mark, bool overwrite,
               const std::vector<std::string>& inputs);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

  void add_folder(const std::string& name) const;
  void add_file(const std::string& name, std::string_view content) const;
  /// Throws RunError if the system fails, or if a file or folder of this name has appeared that may
  /// not be replaced. A folder that should have been replaced is then back in place.
  void publish();

 private:
  void require_replaceable() const;

  std::string path_, mark_, temporary_;
  bool overwrite_;
};

}  // namespace grseg
