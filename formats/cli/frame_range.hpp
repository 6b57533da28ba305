// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/tool.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace grseg {

/// `time` (s) as a number of whole time steps of length `step` (s), so that rounding cannot move a
/// frame across this limit. Throws UsageError, which names `option`, if the number is too large.
std::int64_t whole_steps(double time, double step, const char* option);

/// The frames of a run that a tool uses: every `stride`-th frame with begin <= t < end.
struct FrameRange {
  std::optional<double> begin = {}, end = {};  // limits, s; empty: no limit
  int stride = 1;

  /// Adds --begin --end --stride.
  void add_to(po::options_description& options);

  /// Indices of these frames in the file, at least one. Throws UsageError if the stride is below 1,
  /// RunError if no frame lies between begin and end.
  std::vector<std::size_t> frames_of(const TrajectoryReader& run) const;
};

}  // namespace grseg
