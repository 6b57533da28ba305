// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/content_check.hpp"

#include <fmt/format.h>

namespace grseg {

template <int D>
void ContentCheck::add(std::size_t index, const Frame<D>& frame)
{
  ++frames_;
  if (!run_.is_intact(index, frame) && damaged_++ == 0) first_damaged_ = index;
}

template void ContentCheck::add(std::size_t, const Frame<2>&);
template void ContentCheck::add(std::size_t, const Frame<3>&);

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
  const bool closed = run_.closed();
  auto missing = line("not_closed", closed ? 0 : 1, 0, closed);
  if (!closed)
    missing.remark =
        run_.minor_version() == 0
            ? "no /parameters/complete: the run was interrupted or goes on, or its writer sets no "
              "such mark"
            : "/grseg/seal is empty: the run was interrupted or goes on";
  auto damaged = line("damaged_frames", static_cast<double>(damaged_), 0, damaged_ == 0);
  damaged.remark =
      damaged_ == 0 ? fmt::format("{} frames agree with their digests", frames_)
                    : fmt::format("frame {} is the first that is not as written", first_damaged_);
  auto empty = line("no_frames", frames_ == 0 ? 1 : 0, 0, frames_ > 0);
  if (run_.minor_version() == 0) return {missing, empty, damaged};
  const auto damage = run_.damage_outside_frames();
  auto outside = line("damaged_outside_frames", damage.empty() ? 0 : 1, 0, damage.empty());
  outside.remark =
      damage.empty() ? "what the file holds once agrees with its digests and its seal" : damage;
  if (!closed && damage.empty()) outside.remark = "what the file holds once agrees with its digest";
  return {missing, empty, damaged, outside};
}

}  // namespace grseg
