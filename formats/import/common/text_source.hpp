// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// Reads the lines of one or many text files in sequence, with about a megabyte in memory.
/// Decompresses files in gzip, bzip2, xz or zstd (recognised by their first bytes) and skips
/// byte-order marks of UTF-8. Throws UsageError if a file is missing, RunError if the disk fails,
/// and FormatError with file and line if compressed data are damaged or truncated, if a line is
/// longer than a megabyte, or if the file is of another kind (archive_files.hpp).
class TextSource {
 public:
  explicit TextSource(std::vector<std::string> files);

  /// Advances to the next line; false at the end of the last file.
  bool next();
  /// The current line without its line end, valid until the next call of `next`.
  std::string_view line() const { return line_; }
  /// False if the file ends without a line end: the rest of the line may be missing.
  bool line_is_whole() const { return whole_; }
  /// The file of the current line.
  const std::string& file() const { return files_[opened_ - 1]; }
  /// File and number of the current line: "atoms.dump, line 12".
  std::string place() const;
  /// Throws FormatError with place() and `why`.
  [[noreturn]] void fail(const std::string& why) const;
  /// Throws if the file ends in the middle of `what`: TruncatedArchive if it is the last file.
  /// Otherwise FormatError, because --drop-incomplete would lose the frames of the files that
  /// follow.
  [[noreturn]] void fail_at_end(const char* what);

 private:
  void read_start();
  std::size_t read_more();
  bool take_line();

  std::vector<std::string> files_;
  std::size_t opened_ = 0;  // number of files opened so far
  std::unique_ptr<std::streambuf> stream_;
  std::unique_ptr<char[]> buffer_;   // not initialised: a small file touches little of this memory
  std::size_t begin_ = 0, end_ = 0;  // range of the bytes in buffer_ that are not yet returned
  std::string_view line_;
  std::size_t number_ = 0;
  bool whole_ = true;
};

/// The first `bytes` bytes of a file, decompressed; fewer if it is shorter. Throws UsageError if
/// the file is missing, FormatError if these bytes are damaged or truncated.
std::string unpacked_start(const std::string& file, std::size_t bytes);

/// The words of a line, separated by blanks or tabs.
std::vector<std::string_view> words_of(std::string_view line);

/// A quotation of text from a file for a message: at most 40 characters, all printable.
std::string in_quotes(std::string_view text);

}  // namespace grseg
