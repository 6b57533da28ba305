// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace grseg {

/// "123 of 400 frames, 35/s, 0:08 left"; without rate and time left where nothing is done yet or
/// no time has passed. `seconds` since the work began.
std::string progress_text(std::size_t done, std::size_t total, const std::string& things,
                          double seconds);

/// Tells on standard error how far a program is. On a terminal it is one line that is drawn anew; in
/// a file a line now and then, since nobody watches it; in a pipe, or with `quiet`, nothing. The
/// first line comes when the work turns out to take a while.
class ProgressBar {
 public:
  /// "grseg-render: 12 of 400 frames": `program` does `total` `things`.
  ProgressBar(const char* program, std::string things, std::size_t total, bool quiet);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// Leaves an empty line on the terminal.
  ~ProgressBar();

  /// `done` things are done so far. Not by several threads at once.
  void show(std::size_t done);

 private:
  enum class Where { terminal, file, nowhere };
  static Where standard_error(bool quiet);

  const char* program_;
  std::string things_;
  std::size_t total_;
  Where where_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double next_;  // s since then, at which something is shown again
};

}  // namespace grseg
