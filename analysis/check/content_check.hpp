// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/report.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grseg {

/// Whether a file holds what its writer wrote: it was closed, has frames, and each frame agrees
/// with its digest. TrajectoryReader refuses files that cannot be read at all.
class ContentCheck {
 public:
  explicit ContentCheck(const TrajectoryReader& run);

  /// Any frame, whole (all of TrajectoryReader::Fields).
  void add(std::size_t index, const Frame& frame);
  std::vector<CheckLine> lines() const;

 private:
  const TrajectoryReader& run_;
  std::vector<std::uint64_t> digests_;  // with 0 before the first
  bool float32_;
  std::size_t frames_ = 0, damaged_ = 0, first_damaged_ = 0;
};

}  // namespace grseg
