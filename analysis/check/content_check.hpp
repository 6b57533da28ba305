// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/check/report.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <vector>

namespace grseg {

/// Whether a file holds what its writer wrote: it was closed, has frames, and each frame and what is
/// there once agree with their digests. TrajectoryReader refuses files that cannot be read at all.
class ContentCheck {
 public:
  /// `run` is best opened with Verify::no, so that all damaged frames are counted.
  explicit ContentCheck(const TrajectoryReader& run) : run_(run) {}

  /// Any frame, whole (all of TrajectoryReader::Fields).
  template <int D>
  void add(std::size_t index, const Frame<D>& frame);
  std::vector<CheckLine> lines() const;

 private:
  const TrajectoryReader& run_;
  std::size_t frames_ = 0, damaged_ = 0, first_damaged_ = 0;
};

}  // namespace grseg
