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

/// The range of frames to import, begin <= t < end, from --begin and --end. A bound is a time in
/// the archive's units ("12.5") or a step ("step:100000"). Times are equal if they agree to nine
/// digits, because step times length of a step is compared with a time that a user typed.
class ArchiveRange {
 public:
  /// Throws UsageError if a text is not a bound.
  ArchiveRange(const std::optional<std::string>& begin, const std::optional<std::string>& end);

  enum class Side { before, within, after };
  /// Position of a frame relative to the range. `step` is the length of a time step, which converts
  /// between steps and times. Throws UsageError if the conversion is needed and `step` is empty.
  Side side(const ArchiveFrame& frame, const std::optional<double>& step);
  /// Text about all frames so far: "12 frames from t = 0 (step 0) to t = 1.1 (step 110000)".
  std::string seen() const;
  /// The options of the range: "--begin 5 --end 6".
  const std::string& text() const { return text_; }
  bool any_seen() const { return count_ > 0; }

 private:
  struct Bound {
    const char* option;
    bool is_end;
    std::optional<double> time;  // bound as a time; empty: the bound is `step`
    std::int64_t step = 0;
  };

  void add(const char* option, const std::optional<std::string>& text);
  static int compare(const ArchiveFrame& frame, const Bound& bound,
                     const std::optional<double>& step);

  std::string text_;
  std::vector<Bound> bounds_;
  std::size_t count_ = 0;
  std::string first_, last_;
};

/// Selects frames if an archive has several at the same time (--repeated), in order of time.
class RepeatedFrames {
 public:
  /// Reads the whole archive once if, of repeated frames, the last is to be imported.
  explicit RepeatedFrames(const ImportSettings& settings);

  /// True if `frame`, the archive's next frame, is to be imported. Throws UsageError if a repeated
  /// frame differs from the earlier one and --repeated is not given.
  bool counts(const ArchiveFrame& frame);
  /// A sentence with the number of frames left out; "" if there are none.
  std::string remark() const;

 private:
  bool comes_again(const ArchiveFrame& frame, double time);

  Repeated which_ = Repeated::ask;
  std::vector<bool> last_ones_;           // by frame of the archive: true: import it
  std::size_t next_ = 0;                  // index of the next frame in last_ones_
  std::map<double, std::uint64_t> seen_;  // digests (hashes) of the grains, by time
  std::size_t same_ = 0, dropped_ = 0;
};

/// The frames of an archive between --begin and --end, in order of time. With --drop-incomplete,
/// incomplete frames are left out.
class ArchiveFrames {
 public:
  explicit ArchiveFrames(const ImportSettings& settings);

  /// Reads the next frame; false at the end. Throws UsageError if all frames are out of the range.
  bool next(ArchiveFrame& frame) { return advance(frame, &Archive::next); }
  /// Reads the grains of the next frame; its contacts may be missing.
  bool next_grains(ArchiveFrame& frame)
  {
    // The contacts may be incomplete, too, so they must be read.
    return advance(frame, drop_incomplete_ ? &Archive::next : &Archive::next_grains);
  }
  const Archive& archive() const { return *archive_; }
  /// Sentences about the frames left out so far, and the reasons.
  std::vector<std::string> remarks() const;

 private:
  using Read = bool (Archive::*)(ArchiveFrame&);
  bool advance(ArchiveFrame& frame, Read read);
  bool read_one(ArchiveFrame& frame, Read read);
  void set_time(ArchiveFrame& frame) const;

  std::unique_ptr<Archive> archive_;
  std::optional<double> step_, interval_;  // values of --step, --frame-interval
  bool drop_incomplete_;
  int dropped_ = 0;  // number of incomplete frames left out
  std::vector<ToldCell> cells_;
  RepeatedFrames repeated_;
  ArchiveRange range_;
  bool found_ = false, ended_ = false;
};

}  // namespace grseg
