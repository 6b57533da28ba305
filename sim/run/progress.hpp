// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// s, of a clock that only runs forward.
double seconds_now();

/// One line on the terminal that shows how far a run is; nothing where standard error is a file.
class Progress {
 public:
  /// Of a run from `from` to `end`, s.
  Progress(double from, double end, bool quiet);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  void clear() const;
  void show(const std::string& text) const;
  /// Shows the time of the run, s, and the wall time that is left; at most five times a second.
  void show_time(double time);

 private:
  double from_, end_;
  bool shown_;
  double begin_ = seconds_now(), last_ = 0;
};

}  // namespace grseg
