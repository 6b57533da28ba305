// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/files.hpp"

#include <string>
#include <string_view>

namespace grseg {

/// A file that appears whole or not at all: it is written under a temporary name and renamed by
/// `publish`; without that it is removed.
class Output {
 public:
  /// UsageError where `path` is a folder, or an existing file unless `overwrite`.
  Output(std::string path, bool overwrite);

  const std::string& temporary() const { return temporary_.path(); }
  /// Everything must have been written and closed. RunError where the system refuses.
  void publish() { publish_file(temporary(), path_); }

 private:
  std::string path_;
  RemoveAtEnd temporary_;
};

/// Writes `text` to `path`, whole or not at all; "-" or "" is standard output, and devices and
/// pipes are written to directly. RunError on failure.
void write_whole(const std::string& path, std::string_view text);

}  // namespace grseg
