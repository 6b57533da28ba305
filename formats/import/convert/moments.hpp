// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/facts/cell_and_walls.hpp"
#include "formats/import/facts/import_settings.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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

/// Picks the moments of an archive that count, in order of time.
class RepeatedMoments {
 public:
  explicit RepeatedMoments(Repeated which) : which_(which) {}
  bool needs_all_times() const { return which_ == Repeated::last; }
  /// Of all moments, as they follow in the archive; needed for Repeated::last alone.
  void set_times(const std::vector<double>& times);

  /// Whether this moment, the next one of the archive, counts. UsageError where one comes again
  /// otherwise than before, and nothing says which counts.
  bool counts(const ArchiveMoment& moment);
  /// How many did not, in a sentence; "" where all did.
  std::string remark() const;

  /// The step, or the time where there is none.
  static double time_of(const ArchiveMoment& moment);

 private:
  bool comes_again(const ArchiveMoment& moment, double time);

  Repeated which_;
  std::vector<bool> last_ones_;           // of the moments in the archive
  std::size_t next_ = 0;                  // of these
  std::map<double, std::uint64_t> seen_;  // digests of grains, by time
  std::size_t same_ = 0, dropped_ = 0;
};

/// The moments of an archive between --begin and --end, in order of time. --drop-incomplete leaves out
/// incomplete ones.
class Moments {
 public:
  Moments(const ImportSettings& settings, const std::string& columns);

  /// Reads the next moment; false at the end. UsageError at an end without any moment, where there
  /// are others outside the range.
  bool next(ArchiveMoment& moment) { return advance(moment, &Archive::next); }
  /// The same with the grains alone; contacts may be there or not.
  bool next_grains(ArchiveMoment& moment)
  {
    // Contacts, too, may be what is incomplete.
    return advance(moment, drop_incomplete_ ? &Archive::next : &Archive::next_grains);
  }

  const Archive& archive() const { return *archive_; }
  /// Which moments are left out so far, and why, a sentence each.
  std::vector<std::string> remarks() const;

 private:
  using Read = bool (Archive::*)(ArchiveMoment&);
  bool advance(ArchiveMoment& moment, Read read);
  bool read_one(ArchiveMoment& moment, Read read);

  std::unique_ptr<Archive> archive_;
  void set_time(ArchiveMoment& moment) const;
  std::optional<double> step_, interval_;  // --step, --frame-interval
  bool drop_incomplete_;
  int dropped_ = 0;  // moments
  std::vector<ToldCell> cells_;
  RepeatedMoments repeated_;
  MomentRange range_;
  bool found_ = false, ended_ = false;
};

}  // namespace grseg
