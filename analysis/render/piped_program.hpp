// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grseg {

/// Where the program `name` lies in the folders of PATH, or nothing.
std::optional<std::string> find_program(const std::string& name);

/// Another program, which reads its standard input from a pipe of ours. It is started without a
/// shell, and in a process group of its own, so that Ctrl-C reaches us alone.
class PipedProgram {
 public:
  /// `path` as found; RunError where it cannot be started. A program that stops reading is from here
  /// on told by `write`, not by SIGPIPE.
  PipedProgram(const std::string& path, const std::vector<std::string>& arguments);
  PipedProgram(const PipedProgram&) = delete;
  PipedProgram& operator=(const PipedProgram&) = delete;
  /// Kills it, unless it has been waited for.
  ~PipedProgram();

  /// Whether it has taken all bytes; false where it reads no more. Interruption as in
  /// stop_if_interrupted(), also while it does not read.
  bool write(std::span<const std::uint8_t> bytes);

  /// Its exit code, or 128 and the number of the signal that ended it, and what it said on standard
  /// error.
  struct End {
    int code;
    std::string said;
  };
  /// Ends its input and waits until it ends; Interruption as above.
  End finish();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  /// Its exit code as in End, if it has ended; `wait` until then.
  std::optional<int> ended(bool wait);

  std::unique_ptr<std::FILE, Closer> errors_;  // without a name
  int pipe_ = -1;
  pid_t process_ = -1;
};

}  // namespace grseg
