// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace grseg {

/// What a program has to do: `total` things, of which it begins at `from`, such as 150 "s of flow"
/// from t = 10 s on. A total of 0 is not known.
struct Work {
  std::string things;
  double total = 0;
  double from = 0;
  int digits = 0;  // behind the decimal point
};

/// "123 of 400 frames, 35/s, 0:08 left"; without rate and time left where nothing is done yet or
/// no time has passed, without what depends on the total where that is not known. `seconds` since
/// the work began.
std::string progress_text(double done, const Work& work, double seconds);

/// Writes to standard error as far as it can: a terminal that is gone, or a log on a full disk, is no
/// reason to stop.
void tell(std::string_view text);

/// Tells on standard error how far a program is. On a terminal it is one line that is drawn anew; in
/// a file a line now and then, since nobody watches it; in a pipe, or with `quiet`, nothing. The
/// first line comes when the work turns out to take a while.
class ProgressBar {
 public:
  /// "grseg-render: 12 of 400 frames": `program` does `work`.
  ProgressBar(const char* program, Work work, bool quiet);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// Clears the line.
  ~ProgressBar() { clear(); }

  /// Work that turns out to be another; its time begins now.
  void begin(Work work);
  /// So much is done so far. Not by several threads at once.
  void show(double done);
  /// What goes on without a number, at once and on a terminal only: "depositing the bed".
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

/// Tells on a terminal what is run next: "next: grseg-fit stress.tsv". Nothing in a file, in a pipe
/// or with `quiet`.
void say_next(const std::string& command, bool quiet);

}  // namespace grseg
