// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace grseg {

/// The place that a file will have once it is whole: it is made beside, as
/// PLACE.tmp.PROCESS, and renamed by `publish`; what was not published is removed.
class Output {
 public:
  /// UsageError where something else is at `place`, unless `overwrite` allows to replace a file.
  Output(std::string place, bool overwrite);
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output();

  const std::string& beside() const { return beside_; }
  /// Everything must have been written and closed. RunError where the system refuses.
  void publish();

 private:
  std::string place_, beside_;
};

/// PLACE.tmp.PROCESS: a name for what is under way that no other program takes.
std::string name_beside(const std::string& place);

/// Writes `text` to `path`, whole or not at all (write beside, fsync, rename); "-" or "" is
/// standard output. RunError where that fails.
void write_whole(const std::string& path, std::string_view text);

}  // namespace grseg
