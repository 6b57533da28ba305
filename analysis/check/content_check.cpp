// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/content_check.hpp"

#include "formats/trajectory/digest.hpp"

#include <fmt/format.h>

namespace grseg {

ContentCheck::ContentCheck(const TrajectoryReader& run)
    : run_(run), digests_(run.digests()), float32_(run.stores_float32())
{
  digests_.insert(digests_.begin(), 0);
}

void ContentCheck::add(std::size_t index, const Frame& frame)
{
  ++frames_;
  if (frame_digest(frame, digests_[index], float32_) == digests_[index + 1]) return;
  if (damaged_++ == 0) first_damaged_ = index;
}

std::vector<CheckLine> ContentCheck::lines() const
{
  const auto line = [](const char* quantity, double measured, double tolerance, bool passed) {
    CheckLine result;
    result.quantity = quantity;
    result.measured = measured;
    result.tolerance = tolerance;
    result.verdict = passed ? Verdict::passed : Verdict::failed;
    return result;
  };
  const bool complete = run_.parameters().numbers.contains("complete");
  auto missing = line("not_closed", complete ? 0 : 1, 0, complete);
  if (!complete)
    missing.remark =
        "no /parameters/complete: the run was interrupted or goes on, or its writer sets no such "
        "mark";
  auto damaged = line("damaged_frames", static_cast<double>(damaged_), 0, damaged_ == 0);
  damaged.remark =
      damaged_ == 0 ? fmt::format("{} frames agree with their digests", frames_)
                    : fmt::format("frame {} is the first that is not as written", first_damaged_);
  auto empty = line("no_frames", frames_ == 0 ? 1 : 0, 0, frames_ > 0);
  return {missing, empty, damaged};
}

}  // namespace grseg
