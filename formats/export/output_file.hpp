// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/output.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// A file that is written piece by piece and appears whole or not at all. It is gzip where its name
/// ends in .gz, without a time in its header: the same content gives the same bytes.
class OutputFile {
 public:
  /// UsageError where `path` cannot be what is made of `inputs` (check_output()), RunError where it
  /// cannot be created.
  OutputFile(const std::string& path, bool overwrite, const std::vector<std::string>& inputs);
  ~OutputFile();

  /// RunError where the system refuses.
  void write(std::string_view bytes);
  /// Hands the last bytes to the system; RunError where it refuses. Of several files that
  /// belong together all are closed before one is published.
  void close();
  void publish();

 private:
  struct Packer;
  std::string name_;
  Output output_;
  std::unique_ptr<Packer> packer_;  // of a file that is compressed
};

/// A folder of files that appears whole or not at all.
class OutputFolder {
 public:
  /// `mark` is a file by which an earlier export is recognised: no other folder is ever replaced,
  /// nor one that holds one of `inputs`, not even with `overwrite` (UsageError).
  OutputFolder(std::string path, std::string mark, bool overwrite,
               const std::vector<std::string>& inputs);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

  void add_folder(const std::string& name) const;
  void add_file(const std::string& name, std::string_view content) const;
  /// RunError where the system refuses, or where something of this name has appeared that may not
  /// be replaced; a folder that was to be replaced is then back in place.
  void publish();

 private:
  void require_replaceable() const;

  std::string path_, mark_, temporary_;
  bool overwrite_;
};

}  // namespace grseg
