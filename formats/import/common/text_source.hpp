// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// The lines of one or many text files, one after the other, holding about a megabyte at a time.
/// Files compressed by gzip or zstd (told by their first bytes) are unpacked on the way.
/// UsageError where a file is missing, FormatError naming file and line where compressed data is
/// damaged or a line longer than a megabyte, RunError where the disk fails.
class TextSource {
 public:
  explicit TextSource(std::vector<std::string> files);
  ~TextSource();
  TextSource(TextSource&&) noexcept;

  /// Goes to the next line; false at the end of the last file.
  bool next();
  /// The line without its end, valid until `next`.
  std::string_view line() const;
  /// False where the line ends with its file: the rest of it may be missing.
  bool line_is_whole() const;
  /// "atoms.dump, line 12": the line that `line` is.
  std::string place() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What stands in a file, fit to be quoted in a sentence: at most 40 characters, all printable.
std::string printable(std::string_view text);

}  // namespace grseg
