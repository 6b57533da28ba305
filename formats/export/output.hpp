// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/output.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace grseg {

/// Bytes written in order to a file, gzip where its name ends in .gz (without a time in its header:
/// the same content gives the same bytes).
class ByteSink {
 public:
  /// Writes to `path`; `name` ends in .gz or not. RunError where it cannot be created.
  ByteSink(const std::string& path, const std::string& name);
  ~ByteSink();

  /// RunError where the disk is full.
  void write(std::string_view bytes);
  /// RunError likewise: only then are all bytes with the system. Once closed it stays so.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A file of which whole frames are written one after the other.
class OutputFile {
 public:
  OutputFile(const std::string& path, bool overwrite)
      : output_(path, overwrite), sink_(output_.beside(), path)
  {
  }
  void write(std::string_view bytes) { sink_.write(bytes); }
  /// Of several files that belong together all are closed before one is published.
  void close() { sink_.close(); }
  void publish()
  {
    close();
    output_.publish();
  }

 private:
  Output output_;
  ByteSink sink_;
};

/// A folder of files that appears as a whole.
class OutputFolder {
 public:
  /// `mark` is a file by which a folder is known to have been made here: no other is ever replaced,
  /// not even with `overwrite` (UsageError).
  OutputFolder(std::string path, std::string mark, bool overwrite);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

  void add_folder(const std::string& name) const;
  void add_file(const std::string& name, std::string_view bytes) const;
  void publish();

 private:
  std::string path_, mark_, beside_;
};

}  // namespace grseg
