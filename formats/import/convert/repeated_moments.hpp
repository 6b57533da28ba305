// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"
#include "formats/import/facts/import_settings.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

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

}  // namespace grseg
