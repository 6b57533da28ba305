// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace grseg {

/// Exit codes, the same for every tool.
enum ExitCode {
  exit_done = 0,      ///< done, also if a tolerance was missed (the summary then reports it)
  exit_trouble = 1,   ///< run-time error: disk full, no usable data, run out of bounds
  exit_usage = 2,     ///< wrong command line or missing input file
  exit_content = 3,   ///< wrong content of a file: unknown key, truncated, NaN, corrupt
  exit_check = 4,     ///< a check failed, or a tolerance was missed with --strict
  exit_signal = 128,  ///< 128 + number of the signal (SIGINT: 130); finished output remains
};

/// Error that stops a tool: an exit code and one sentence for the user, which names the file, the
/// place and the remedy.
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

/// Wrong content of a file.
struct FormatError : ToolError {
  explicit FormatError(const std::string& sentence) : ToolError(exit_content, sentence) {}
};

/// An error while running: a full disk, no usable data, a run out of bounds.
struct RunError : ToolError {
  explicit RunError(const std::string& sentence) : ToolError(exit_trouble, sentence) {}
};

/// A check failed or a tolerance was missed.
struct CheckError : ToolError {
  explicit CheckError(const std::string& sentence) : ToolError(exit_check, sentence) {}
};

}  // namespace grseg
