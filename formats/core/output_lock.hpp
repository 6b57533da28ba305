// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// Locks the open file `file` for this process without waiting; 0, EWOULDBLOCK where another
/// process has it, or another errno.
int lock_file(int file);

/// One writer per output: as long as this exists no other process can make one for the same `path`,
/// on this computer and on others that share its folder. It is a lock on the file PATH.lock, which
/// goes with it, so that it also works where the output's own library cannot lock. The system
/// releases the lock of a process that dies; the file that it leaves behind hinders nobody.
///
/// Where the file system has no locks, PATH.lock itself is the lock: it names the computer, the
/// process and the time at which that began. It is taken over where that process has died on this
/// computer; a lock from another computer must be removed by hand.
class OutputLock {
 public:
  /// UsageError naming the process that writes `path`; RunError where PATH.lock cannot be created.
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
