// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

namespace grseg {

/// Work in a process of its own on a file that anybody may have made. The HDF5 library crashes, never
/// ends or asks for any memory on some damaged files; here this becomes a sentence.
class Apart {
 public:
  using Send = std::function<void(const std::string& message)>;
  using Work = std::function<void(const Send& send)>;

  /// Begins `work`, which sends messages about `file`. RunError where no process can be had.
  Apart(std::string file, const Work& work);
  Apart(const Apart&) = delete;
  Apart& operator=(const Apart&) = delete;
  /// Ends the process.
  ~Apart();

  /// The next message, which stays until the one behind it is received. ToolError with the sentence
  /// and the exit code of what `work` threw. FormatError naming `place` where the process crashes, or
  /// where the message takes more processor time or memory than the size of the file explains.
  const std::string& receive(const std::string& place);

 private:
  [[noreturn]] void explain_end(const std::string& place);

  std::string file_;
  pid_t process_ = -1;
  int end_ = -1;  // of the pipe
  std::string message_;
};

}  // namespace grseg
