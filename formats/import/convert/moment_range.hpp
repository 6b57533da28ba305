// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace grseg {

/// One end of a range of moments, as --begin and --end give it.
struct MomentBound {
  std::optional<double> time;  // in the archive's units; otherwise
  std::int64_t step = 0;
};

/// "12.5", a time, or "step:100000". UsageError naming `option` otherwise.
MomentBound parse_bound(const std::string& text, const std::string& option);

/// The moments of an archive that are imported: begin <= t < end. Times count as equal to nine
/// digits, so that step times the length of a step meets a time that was typed.
class MomentRange {
 public:
  /// UsageError where a text is not a bound.
  MomentRange(const std::optional<std::string>& begin, const std::optional<std::string>& end);

  /// The length of a step, with which a moment that has only a step or only a time is compared with
  /// the other.
  void set_step(const std::optional<double>& step) { step_ = step; }

  enum class Side { before, within, after };
  /// Where a moment lies. UsageError where this needs the length of a step.
  Side side(const ArchiveMoment& moment);

  /// Of all moments so far: "12 moments from t = 0 (step 0) to t = 1.1 (step 110000)".
  std::string seen() const;
  /// "--begin 5 --end 6"
  std::string text() const;
  bool any_seen() const { return count_ > 0; }
  bool is_all() const { return !begin_ && !end_; }

 private:
  int compare(const ArchiveMoment& moment, const MomentBound& bound, const char* option) const;

  std::string text_;
  std::optional<MomentBound> begin_, end_;
  std::optional<double> step_;
  std::size_t count_ = 0;
  std::string first_, last_;
};

}  // namespace grseg
