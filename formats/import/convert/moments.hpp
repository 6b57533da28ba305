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

/// The moments of an archive that are imported, begin <= t < end, as --begin and --end give them: "12.5",
/// a time in the archive's units, or "step:100000". Times count as equal to nine digits, so that step
/// times the length of a step meets a time that was typed.
class MomentRange {
 public:
  /// UsageError where a text is not a bound.
  MomentRange(const std::optional<std::string>& begin, const std::optional<std::string>& end);

  enum class Side { before, within, after };
  /// Where a moment lies. `step`, the length of one, is that with which a moment that has only a step
  /// or only a time is compared with the other. UsageError where it is needed and not known.
  Side side(const ArchiveMoment& moment, const std::optional<double>& step);
  /// A sentence on all moments so far: "12 moments from t = 0 (step 0) to t = 1.1 (step 110000)".
  std::string seen() const;
  /// "--begin 5 --end 6"
  const std::string& text() const { return text_; }
  bool any_seen() const { return count_ > 0; }

 private:
  struct Bound {
    const char* option;
    bool is_end;
    std::optional<double> time;  // otherwise
    std::int64_t step = 0;
  };

  void add(const char* option, const std::optional<std::string>& text);
  static int compare(const ArchiveMoment& moment, const Bound& bound,
                     const std::optional<double>& step);

  std::string text_;
  std::vector<Bound> bounds_;
  std::size_t count_ = 0;
  std::string first_, last_;
};

/// Picks the moments of an archive that count, in order of time.
class RepeatedMoments {
 public:
  /// Reads all moments once where the last ones count.
  explicit RepeatedMoments(const ImportSettings& settings);

  /// True where this moment, the next one of the archive, counts. UsageError where one comes again
  /// otherwise than before, and nothing says which counts.
  bool counts(const ArchiveMoment& moment);
  /// How many did not, in a sentence; "" where all did.
  std::string remark() const;

 private:
  bool comes_again(const ArchiveMoment& moment, double time);

  Repeated which_ = Repeated::ask;
  std::vector<bool> last_ones_;           // of the moments in the archive
  std::size_t next_ = 0;                  // of these
  std::map<double, std::uint64_t> seen_;  // digests of grains, by time
  std::size_t same_ = 0, dropped_ = 0;
};

/// The moments of an archive between --begin and --end, in order of time. --drop-incomplete leaves out
/// incomplete ones.
class Moments {
 public:
  explicit Moments(const ImportSettings& settings);

  /// Reads the next moment; false at the end. UsageError at an end without any moment, where there
  /// are others outside the range.
  bool next(ArchiveMoment& moment) { return advance(moment, &Archive::next); }
  /// Like `next`, with the grains alone; contacts may be there or not.
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
  void set_time(ArchiveMoment& moment) const;

  std::unique_ptr<Archive> archive_;
  std::optional<double> step_, interval_;  // --step, --frame-interval
  bool drop_incomplete_;
  int dropped_ = 0;  // moments
  std::vector<ToldCell> cells_;
  RepeatedMoments repeated_;
  MomentRange range_;
  bool found_ = false, ended_ = false;
};

}  // namespace grseg
