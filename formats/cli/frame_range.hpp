// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/tool.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace grseg {

/// `time` in whole steps, so that no rounding moves a frame across it. UsageError naming `option`
/// where no run can have this time.
std::int64_t whole_steps(double time, double step, const char* option);

/// The part of a run to be used: frames with begin <= t < end, one in `stride`.
struct FrameRange {
  std::optional<double> begin = {}, end = {};  // s; by default the whole run
  int stride = 1;

  /// Adds --begin --end --stride.
  void add_to(po::options_description& options);

  /// Numbers of these frames in the file, at least one. UsageError where the stride is below 1,
  /// RunError where no frame lies between begin and end.
  std::vector<std::size_t> frames_of(const TrajectoryReader& run) const;
};

}  // namespace grseg
