// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/convert/moment_range.hpp"
#include "formats/import/convert/repeated_moments.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "formats/import/facts/told_cell.hpp"

#include <memory>
#include <string>
#include <vector>

namespace grseg {

/// The moments of an archive between --begin and --end, in order of time; with --drop-incomplete they
/// end before one that is incomplete.
class Moments {
 public:
  Moments(const ImportSettings& settings, const std::string& columns);

  /// Reads the next moment; false at the end. UsageError at an end without any moment, where there
  /// are others outside the range.
  bool next(ArchiveMoment& moment) { return advance(moment, &Archive::next); }
  /// The same with the grains alone; contacts may be there or not.
  bool next_grains(ArchiveMoment& moment) { return advance(moment, &Archive::next_grains); }

  const Archive& archive() const { return *archive_; }
  const MomentRange& range() const { return range_; }
  const RepeatedMoments& repeated() const { return repeated_; }

 private:
  using Read = bool (Archive::*)(ArchiveMoment&);
  bool advance(ArchiveMoment& moment, Read read);
  bool read_one(ArchiveMoment& moment, Read read);

  std::unique_ptr<Archive> archive_;
  void set_time(ArchiveMoment& moment) const;
  std::optional<double> step_, interval_;  // --step, --frame-interval
  bool drop_incomplete_;
  std::vector<ToldCell> cells_;
  RepeatedMoments repeated_;
  MomentRange range_;
  bool found_ = false, ended_ = false;
};

}  // namespace grseg
