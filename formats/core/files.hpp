// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// How every program creates, publishes and removes files: what is being written has a temporary
/// name and gets its own once it is whole and on disk.
namespace grseg {

/// UsageError unless `path` is a file that can be read.
void require_file(const std::string& path);

/// The sentence for an output that exists and may not be replaced.
std::string already_exists(const std::string& path);

/// True where something has this name, even a link that leads nowhere.
bool is_taken(const std::string& path);

/// True where both names lead to one file or folder.
bool same_file(const std::string& a, const std::string& b);

/// True where `path` is a device or a pipe, which is written to, never replaced.
bool is_device(const std::string& path);

/// UsageError where `output` is one of `inputs` under any name (symbolic and hard links), or a
/// folder in which one of them lies. Inputs that do not exist are passed over.
void refuse_input_as_output(const std::string& output, const std::vector<std::string>& inputs);

/// Checks, before a program begins to work, that it may write `path`. UsageError where `path` is
/// one of `inputs`, also with `overwrite`; where it is a folder, a device or a pipe; and where it
/// exists, unless `overwrite`. RunError where its folder is missing or not writable.
void check_output(const std::string& path, bool overwrite, const std::vector<std::string>& inputs);

/// The system's sentence for `error`, an errno, followed by a question that helps where it is
/// obscure.
std::string reason(int error);

/// PATH.tmp.PROCESS: a name beside `path` that no other program uses.
std::string temporary_path(const std::string& path);

/// Creates or replaces the file `path` with `content`; messages call it `name`. RunError on
/// failure.
void write_file(const std::string& path, std::string_view content, const std::string& name);

/// Adds `content` to the end of the file `path`, otherwise as write_file().
void append_to_file(const std::string& path, std::string_view content, const std::string& name);

/// Waits until the file `path` is on disk. RunError on failure.
void flush_to_disk(const std::string& path);

/// Waits until everything on the file system of `path` is on disk: one call for a folder of many
/// files. RunError on failure.
void flush_file_system(const std::string& path);

/// Renames `from` to `to`, replacing a file. RunError on failure.
void rename_path(const std::string& from, const std::string& to);

/// Renames `from` to `to` without replacing anything: RunError, which ends with `remedy`, where
/// `to` has appeared in the meantime.
void rename_to_new(const std::string& from, const std::string& to, const std::string& remedy);

/// Gives the file `path` the name `second` too, replacing the file that had it. Where the file
/// system knows no second names the file loses its first one. RunError on failure.
void keep_as(const std::string& path, const std::string& second);

/// Flushes the closed file `temporary` to disk and renames it to `path`, so that `path` is whole or
/// absent. Nothing is replaced unless `overwrite`, as in rename_to_new(). RunError on failure;
/// `temporary` then still exists.
void publish_file(const std::string& temporary, const std::string& path, bool overwrite,
                  const std::string& remedy = "choose another name");

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

/// Memory that programs of this machine can still get, bytes (MemAvailable of /proc/meminfo);
/// infinity where it is unknown.
double free_memory();

}  // namespace grseg
