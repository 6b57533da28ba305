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
  struct Stream;
  Output output_;
  std::unique_ptr<Stream> stream_;
};

}  // namespace grseg
