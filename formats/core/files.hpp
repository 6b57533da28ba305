// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Functions by which every program creates, publishes and removes files. A file is written under a
/// temporary name and renamed when it is complete and on disk.
namespace grseg {

/// Throws UsageError unless `path` is a readable file.
void require_file(const std::string& path);

/// Throws UsageError unless `path` is a readable file that can be read several times.
void require_seekable(const std::string& path);

/// Error message for an output that exists and may not be replaced.
std::string already_exists(const std::string& path);

/// True if a file, folder or link has this name, even a broken symbolic link.
bool is_taken(const std::string& path);

/// The file or the free name to which the symbolic link `path` leads; `path` itself if it is none,
/// or a device.
std::string behind_links(const std::string& path);

/// True if both names refer to one file or folder.
bool same_file(const std::string& a, const std::string& b);

/// True if `path` is a device or a pipe. Programs write to a device but never replace it.
bool is_device(const std::string& path);

/// Throws UsageError if `output` is one of `inputs` under any name (symbolic and hard links), or a
/// folder that contains one of `inputs`. Inputs that do not exist are ignored.
void refuse_input_as_output(const std::string& output, const std::vector<std::string>& inputs);

/// Checks, before a program begins to work, that it may write `path`. Throws UsageError if `path`
/// is one of `inputs` (also with `overwrite`), a folder, a device or a pipe, or if `path` exists
/// and `overwrite` is false. Throws RunError unless a file can be created beside `path` and renamed.
void check_output(const std::string& path, bool overwrite, const std::vector<std::string>& inputs);

/// The system's message for the errno `error`; a remedy follows if one is known.
std::string reason(int error);

/// Temporary name PATH.tmp.PROCESS, which no other program uses.
std::string temporary_path(const std::string& path);

/// Creates an empty file named temporary_path(path). Throws RunError if it exists: a process of
/// another computer or container has the same number.
std::string new_temporary(const std::string& path);

/// Removes the files that processes which have ended left as temporary_path(path). Only the one
/// writer of `path` (OutputLock) may call it, before it writes: the processes of other computers
/// look as if they had ended.
void remove_temporaries(const std::string& path);

/// Creates or replaces the file `path` with `content`. Throws RunError on failure; its message
/// calls the file `name`.
void write_file(const std::string& path, std::string_view content, const std::string& name);

/// Appends `content` to the file `path`; otherwise like write_file().
void append_to_file(const std::string& path, std::string_view content, const std::string& name);

/// Waits until the file `path` is on disk. Throws RunError on failure.
void flush_to_disk(const std::string& path);

/// Waits until everything on the file system of `path` is on disk: one call for a folder of many
/// files. Throws RunError on failure.
void flush_file_system(const std::string& path);

/// Renames `from` to `to` and replaces a file of this name. Throws RunError on failure.
void rename_path(const std::string& from, const std::string& to);

/// Renames `from` to `to` without replacing anything. If `to` exists by now, throws RunError, whose
/// message ends with `remedy`.
void rename_to_new(const std::string& from, const std::string& to, const std::string& remedy);

/// Adds `second` as another name (hard link) of the file `path`, replacing the file that had this
/// name. On a file system without hard links the file is renamed. Throws RunError on failure.
void keep_as(const std::string& path, const std::string& second);

/// Flushes the closed file `temporary` to disk and renames it to `path`, so that `path` is whole or
/// absent. Without `overwrite` nothing is replaced, as in rename_to_new(). Throws RunError on
/// failure; `temporary` then still exists.
void publish_file(const std::string& temporary, const std::string& path, bool overwrite,
                  const std::string& remedy = "choose another name");

/// Removes the file `path` at the end of the scope if the file exists; with If::empty only if the
/// file is also empty.
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
