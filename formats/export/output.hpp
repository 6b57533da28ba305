// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace grseg {

/// A place that a file or folder will have once it is whole: it is made beside, as PLACE.part, and
/// renamed by `publish`; what was not published is removed.
class Output {
 public:
  /// UsageError where something else is at `place`, unless `overwrite` allows to replace a file.
  Output(std::string place, bool overwrite);
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output();

  const std::string& beside() const { return beside_; }
  /// Everything must have been written and closed. RunError where the system refuses.
  void publish();

 private:
  std::string place_, beside_;
};

/// Bytes written in order to a file, gzip where its name ends in .gz (without a time in its header:
/// the same content gives the same bytes).
class ByteSink {
 public:
  /// Writes to `path`; `name` ends in .gz or not. RunError where it cannot be created.
  ByteSink(const std::string& path, const std::string& name);
  ~ByteSink();

  /// RunError where the disk is full.
  void write(std::string_view bytes);
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
  void publish()
  {
    sink_.close();
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
