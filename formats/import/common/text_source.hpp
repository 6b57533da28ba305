// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// The lines of one or many text files, one after the other, holding about a megabyte at a time.
/// Files packed by gzip, bzip2, xz or zstd (recognised by their first bytes) are unpacked on the way,
/// and byte-order marks of UTF-8 are passed over. UsageError where a file is missing, FormatError
/// naming file and line where packed data are damaged or end early, where a line is longer than a
/// megabyte, or where a file is of another kind (archive_files.hpp); RunError where the disk fails.
class TextSource {
 public:
  explicit TextSource(std::vector<std::string> files);

  /// Advances to the next line; false at the end of the last file.
  bool next();
  /// The line without its end, valid until `next`.
  std::string_view line() const { return line_; }
  /// False where the line ends with its file: the rest of it may be missing.
  bool line_is_whole() const { return whole_; }
  /// The file that `line` is of.
  const std::string& file() const { return files_[opened_ - 1]; }
  /// "atoms.dump, line 12": where `line` is.
  std::string place() const;
  /// FormatError naming it.
  [[noreturn]] void fail(const std::string& why) const;
  /// Where the file ends in the middle of `what`: TruncatedArchive, or FormatError if there is another
  /// file behind it, whose moments must not be lost with --drop-incomplete.
  [[noreturn]] void fail_at_end(const char* what);

 private:
  void read_start();
  std::size_t read_more();
  bool take_line();

  std::vector<std::string> files_;
  std::size_t opened_ = 0;  // files
  std::unique_ptr<std::streambuf> stream_;
  std::unique_ptr<char[]> buffer_;   // memory that a small file does not fill is never touched
  std::size_t begin_ = 0, end_ = 0;  // of what is not yet handed out
  std::string_view line_;
  std::size_t number_ = 0;
  bool whole_ = true;
};

/// The first bytes of a file, unpacked, or all it has. UsageError where it is missing, FormatError where
/// its packed data are damaged or end so early.
std::string unpacked_start(const std::string& file, std::size_t bytes);

/// The words of a line, which are separated by blanks.
std::vector<std::string_view> words_of(std::string_view line);

/// Text of a file as it can be quoted in a message: at most 40 characters, all printable.
std::string in_quotes(std::string_view text);

}  // namespace grseg
