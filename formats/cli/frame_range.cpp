// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/frame_range.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {

std::int64_t whole_steps(double time, double step, const char* option)
{
  const double steps = std::round(time / step);
  if (!(std::abs(steps) < 1e15))
    throw UsageError(fmt::format("{} {:g} s is not a time in this run", option, time));
  return static_cast<std::int64_t>(steps);
}

void FrameRange::add_to(po::options_description& options)
{
  options.add_options()("begin", time_option(begin),
                        "ignore frames before this time (default: use all)");
  options.add_options()("end", time_option(end),
                        "ignore frames from this time on (default: use all)");
  options.add_options()("stride", po::value(&stride)->default_value(1)->value_name("N"),
                        "use one frame in N");
}

std::vector<std::size_t> FrameRange::frames_of(const TrajectoryReader& run) const
{
  if (stride < 1) throw UsageError("--stride must be at least 1");
  const auto& steps = run.steps();
  const auto number_at = [&](const std::optional<double>& time, const char* option,
                             std::size_t otherwise) {
    if (!time) return otherwise;
    const auto step = whole_steps(*time, run.step(), option);
    return static_cast<std::size_t>(std::lower_bound(steps.begin(), steps.end(), step) -
                                    steps.begin());
  };
  std::vector<std::size_t> frames;
  const auto last = number_at(end, "--end", steps.size());
  for (auto k = number_at(begin, "--begin", 0); k < last; k += static_cast<std::size_t>(stride))
    frames.push_back(k);
  if (frames.empty())
    throw RunError(steps.empty()
                       ? fmt::format("{}: the run has no frames", run.path())
                       : fmt::format("{}: no frame lies between --begin and --end; the "
                                     "run goes from {:.6g} s to {:.6g} s",
                                     run.path(), run.times().front(), run.times().back()));
  return frames;
}

}  // namespace grseg
