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

/// Path of the program `name`, searched in the folders of PATH; nothing if there is none.
std::optional<std::string> find_program(const std::string& name);

/// A running program whose standard input is a pipe that this class writes. The program is started without
/// a shell and in a process group of its own, so that Ctrl-C does not reach it.
class PipedProgram {
 public:
  /// Starts the program; `path` as find_program() returns it. Throws RunError if it cannot be started.
  /// SIGPIPE is ignored from now on: write() reports whether the program has stopped reading.
  PipedProgram(const std::string& path, const std::vector<std::string>& arguments);
  PipedProgram(const PipedProgram&) = delete;
  PipedProgram& operator=(const PipedProgram&) = delete;
  /// Kills the program, unless finish() has waited for its end.
  ~PipedProgram();

  /// Writes all bytes; returns false if the program has stopped reading. Throws Interruption, as
  /// stop_if_interrupted() does, even while it waits for the program to read.
  bool write(std::span<const std::uint8_t> bytes);

  /// Result of the program after its end.
  struct End {
    int code;          // exit code, or 128 plus the number of the signal that ended the program
    std::string said;  // text that the program wrote to standard error
  };
  /// Closes the program's input and waits for its end. Throws Interruption as write() does.
  End finish();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  /// End::code, or nothing if the program still runs; with `wait`, waits for its end.
  std::optional<int> ended(bool wait);

  std::unique_ptr<std::FILE, Closer> errors_;  // temporary file with its standard error
  int pipe_ = -1;
  pid_t process_ = -1;
};

}  // namespace grseg
