// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace grseg {

/// Exit codes, the same for every tool.
enum ExitCode {
  exit_done = 0,      ///< done, also when a tolerance was missed (the summary says so)
  exit_trouble = 1,   ///< run-time error: disk full, no usable data, run out of bounds
  exit_usage = 2,     ///< wrong command line or missing input file
  exit_content = 3,   ///< wrong content of a file: unknown key, truncated, NaN, corrupt
  exit_check = 4,     ///< a check failed, or a tolerance missed with --strict
  exit_signal = 128,  ///< plus the number of the signal, 130 of SIGINT; what was committed is kept
};

/// The reason a tool stops: one sentence for the user and an exit code.
/// The sentence names the file, the place and the remedy.
class ToolError : public std::runtime_error {
 public:
  ToolError(ExitCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code)
  {
  }
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Wrong command line or missing input.
struct UsageError : ToolError {
  explicit UsageError(const std::string& sentence) : ToolError(exit_usage, sentence) {}
};

/// A file that does not hold what it should.
struct FormatError : ToolError {
  explicit FormatError(const std::string& sentence) : ToolError(exit_content, sentence) {}
};

/// An error while running: the disk, no usable data, a run out of bounds.
struct RunError : ToolError {
  explicit RunError(const std::string& sentence) : ToolError(exit_trouble, sentence) {}
};

/// A check failed or a tolerance was missed.
struct CheckError : ToolError {
  explicit CheckError(const std::string& sentence) : ToolError(exit_check, sentence) {}
};

}  // namespace grseg
