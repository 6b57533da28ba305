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

/// Path of the program `name` in the folders of PATH, or nothing.
std::optional<std::string> find_program(const std::string& name);

/// A program that reads its standard input from a pipe that we write. It is started without a shell, and
/// in a process group of its own, so that Ctrl-C reaches us alone.
class PipedProgram {
 public:
  /// `path` as find_program() gives it; RunError where it cannot be started. SIGPIPE is ignored from here
  /// on: write() tells if the program has stopped reading.
  PipedProgram(const std::string& path, const std::vector<std::string>& arguments);
  PipedProgram(const PipedProgram&) = delete;
  PipedProgram& operator=(const PipedProgram&) = delete;
  /// Kills the program, unless finish() has waited for it.
  ~PipedProgram();

  /// Writes all bytes; false if the program reads no more. Throws Interruption, as stop_if_interrupted()
  /// does, also while the program does not read.
  bool write(std::span<const std::uint8_t> bytes);

  /// End of the program: its exit code, or 128 and the number of the signal that ended it; and its words on
  /// standard error.
  struct End {
    int code;
    std::string said;
  };
  /// Ends the program's input and waits for its end; Interruption as above.
  End finish();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  /// The code as in End, nothing if the program still runs; with `wait`, waits for its end.
  std::optional<int> ended(bool wait);

  std::unique_ptr<std::FILE, Closer> errors_;  // temporary file with its standard error
  int pipe_ = -1;
  pid_t process_ = -1;
};

}  // namespace grseg
