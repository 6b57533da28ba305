// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace grseg {

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
