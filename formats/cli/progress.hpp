// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace grseg {

/// Amount of work of a program: from `from` (e.g. 10) up to `total` (e.g. 150), in units named
/// `things` (e.g. "s of flow"). A total of 0 means unknown.
struct Work {
  std::string things;
  double total = 0;
  double from = 0;
  int digits = 0;  // number of decimals shown
};

/// "123 of 400 frames, 35/s, 0:08 left", where `seconds` is the time since the work began. Rate and
/// time left are omitted if nothing is done yet or no time has passed; "of 400" and the time left
/// are omitted if the total is unknown, or only an estimate that `done` has passed.
std::string progress_text(double done, const Work& work, double seconds);

/// Writes to standard error and ignores failures: a closed terminal, or a log on a full disk, must
/// not stop a program.
void tell(std::string_view text);

/// Progress display on standard error. A terminal shows one line that is redrawn, a file receives a
/// line now and then, a pipe none; `quiet` suppresses all. The first line appears only if the work
/// takes a while.
class ProgressBar {
 public:
  /// A display such as "grseg-render: 12 of 400 frames" for the work `work` of `program`.
  ProgressBar(const char* program, Work work, bool quiet);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// Clears the line.
  ~ProgressBar() { clear(); }

  /// Starts to display other work, whose time begins now.
  void begin(Work work);
  /// Shows that the work has reached `done` (in units of Work::things). Not thread-safe.
  void show(double done);
  /// Prints a stage of the work that has no count, such as "depositing the bed", at once, but only
  /// on a terminal.
  void say(const std::string& text) const;
  /// Clears the line on the terminal, so that other output can follow.
  void clear() const;

 private:
  enum class Where { terminal, file, nowhere };
  static Where standard_error(bool quiet);

  const char* program_;
  Work work_;
  Where where_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double next_ = 0;  // s after begin_, time of the next output
};

/// Suggests the next command on a terminal: "next: grseg-fit stress.tsv". Prints nothing in a file,
/// in a pipe or with `quiet`.
void say_next(const std::string& command, bool quiet);

}  // namespace grseg
