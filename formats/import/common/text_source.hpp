// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// The lines of one or many text files, one after the other, holding about a megabyte at a time.
/// Files compressed by gzip or zstd (recognised by their first bytes) are unpacked on the way.
/// UsageError where a file is missing, FormatError naming file and line where compressed data is
/// damaged or a line longer than a megabyte, RunError where the disk fails.
class TextSource {
 public:
  explicit TextSource(std::vector<std::string> files);
  ~TextSource();
  TextSource(TextSource&&) noexcept;

  /// Advances to the next line; false at the end of the last file.
  bool next();
  /// The line without its end, valid until `next`.
  std::string_view line() const;
  /// False where the line ends with its file: the rest of it may be missing.
  bool line_is_whole() const;
  /// "atoms.dump, line 12": where `line` is.
  std::string place() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The words of a line, which are separated by blanks.
std::vector<std::string_view> words_of(std::string_view line);

/// Text of a file as it can be quoted in a message: at most 40 characters, all printable.
std::string in_quotes(std::string_view text);

}  // namespace grseg
