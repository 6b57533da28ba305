// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// Locks the open file `file` for this process without waiting. Returns 0 on success, EWOULDBLOCK
/// if another process has the lock, or another errno.
int lock_file(int file);

/// Lock that allows one writer per output. While an OutputLock exists, no other process can create
/// one for the same `path`, on this computer or on others that share the folder. It locks the file
/// PATH.lock, not the output, because the output's own library may be unable to lock. The
/// destructor removes PATH.lock. The system releases the lock of a process that dies; the PATH.lock
/// that such a process leaves behind does not block later writers.
///
/// On a file system without locks the existence of PATH.lock is the lock. The file names the
/// computer, the process and its start time. If this process has died on this computer, the next
/// writer removes the file. A lock from another computer must be removed by hand.
class OutputLock {
 public:
  /// Throws UsageError, which names the other process, if `path` is being written, and RunError if
  /// PATH.lock cannot be created.
  explicit OutputLock(const std::string& path, int (*lock)(int file) = lock_file);
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;
  ~OutputLock();

 private:
  bool take(const std::string& path, int (*lock)(int file));

  std::string path_;
  int file_ = -1;
};

}  // namespace grseg
