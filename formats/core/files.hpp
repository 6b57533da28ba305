// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>

/// How every program creates, publishes and removes files: what is being written has a temporary
/// name and gets its own once it is whole and on disk.
namespace grseg {

/// UsageError unless `path` is a file that can be read.
void require_file(const std::string& path);

/// The sentence for an output that exists and may not be replaced.
std::string already_exists(const std::string& path);

/// UsageError where `path` is a folder, or an existing file unless `overwrite`.
void refuse_to_overwrite(const std::string& path, bool overwrite);

/// PATH.tmp.PROCESS: a name beside `path` that no other program uses.
std::string temporary_path(const std::string& path);

/// Creates or replaces the file `path` with `content`; messages call it `name`. RunError on
/// failure.
void write_file(const std::string& path, std::string_view content, const std::string& name);

/// Waits until the file `path` is on disk. RunError on failure.
void flush_to_disk(const std::string& path);

/// The same for everything on the file system of `path`: one call for a folder of many files.
void flush_file_system(const std::string& path);

/// Renames `from` to `to`, replacing a file. RunError on failure.
void rename_path(const std::string& from, const std::string& to);

/// Flushes the closed file `temporary` to disk and renames it to `path`, so that `path` is whole or
/// absent. RunError on failure; `temporary` then still exists.
void publish_file(const std::string& temporary, const std::string& path);

/// Removes the file `path`, if it exists (and is empty, with If::empty), when it goes out of scope.
class RemoveAtEnd {
 public:
  enum class If { there, empty };
  explicit RemoveAtEnd(std::string path, If condition = If::there)
      : path_(std::move(path)), condition_(condition)
  {
  }
  RemoveAtEnd(const RemoveAtEnd&) = delete;
  RemoveAtEnd& operator=(const RemoveAtEnd&) = delete;
  ~RemoveAtEnd();

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  If condition_;
};

}  // namespace grseg
