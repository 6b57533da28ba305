// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace grseg {

/// The work of a program: `total` things, such as 150 "s of flow", counted from `from`, such as t =
/// 10 s. A total of 0 means unknown.
struct Work {
  std::string things;
  double total = 0;
  double from = 0;
  int digits = 0;  // behind the decimal point
};

/// "123 of 400 frames, 35/s, 0:08 left". Rate and time left are missing where nothing is done yet
/// or no time has passed, and the parts that need the total where it is unknown. `seconds` since
/// the work began.
std::string progress_text(double done, const Work& work, double seconds);

/// Writes to standard error as far as it can: a terminal that is gone, or a log on a full disk, is
/// no reason to stop.
void tell(std::string_view text);

/// Shows progress on standard error: on a terminal in one line that is redrawn, in a file in a line
/// now and then, in a pipe or with `quiet` not at all. The first line appears when the work turns
/// out to take a while.
class ProgressBar {
 public:
  /// "grseg-render: 12 of 400 frames": `program` does `work`.
  ProgressBar(const char* program, Work work, bool quiet);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// Clears the line.
  ~ProgressBar() { clear(); }

  /// Replaces the work by another; its time begins now.
  void begin(Work work);
  /// Shows that `done` of the things are done. Not by several threads at once.
  void show(double done);
  /// Prints a stage of the work that has no number, such as "depositing the bed", at once and on a
  /// terminal only.
  void say(const std::string& text) const;
  /// Leaves an empty line on the terminal, where other words may follow.
  void clear() const;

 private:
  enum class Where { terminal, file, nowhere };
  static Where standard_error(bool quiet);

  const char* program_;
  Work work_;
  Where where_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double next_ = 0;  // s since then, at which something is shown again
};

/// Suggests the next command on a terminal: "next: grseg-fit stress.tsv". Prints nothing in a file,
/// in a pipe or with `quiet`.
void say_next(const std::string& command, bool quiet);

}  // namespace grseg
