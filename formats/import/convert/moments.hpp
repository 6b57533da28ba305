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
