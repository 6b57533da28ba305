// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/windows.hpp"

#include "formats/cli/frame_range.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

using Step = std::int64_t;

/// Steps between two frames of the file.
Step spacing(const RunTimes& run)
{
  const auto n = run.steps.size();
  if (n > 1) return run.steps[n - 1] - run.steps[n - 2];
  return std::max<Step>(1, std::llround(run.frame_interval / run.step));
}

Step first_step(const RunTimes& run, const WindowSettings& settings)
{
  if (settings.begin) return whole_steps(*settings.begin, run.step, "--begin");
  return run.steps.back() < 0 ? run.steps.front() : std::max<Step>(0, run.steps.front());
}

void check(const RunTimes& run, const WindowSettings& settings)
{
  if (run.steps.empty()) throw RunError("the run has no frames");
  if (!(run.step > 0) || !std::isfinite(run.step))
    throw FormatError(fmt::format("the run's step is {:g} s; it should be positive", run.step));
  if (settings.stride < 1) throw UsageError("--stride must be at least 1");
  if (!(settings.length > 0)) throw UsageError("--window must be positive");
}

}  // namespace

std::vector<Window> cut_into_windows(const RunTimes& run, const WindowSettings& settings)
{
  check(run, settings);
  const Step begin = first_step(run, settings), between = spacing(run);
  const Step length = whole_steps(settings.length, run.step, "--window");
  if (length < between * settings.stride)
    throw UsageError(fmt::format(
        "--window {:g} s is shorter than the {:g} s between the frames used; choose a longer one",
        settings.length, static_cast<double>(between * settings.stride) * run.step));

  Step end = run.steps.back() + between;
  if (settings.end) end = std::min(end, whole_steps(*settings.end, run.step, "--end"));
  const double exact = static_cast<double>(length) * run.step;
  const bool whole = std::abs(exact - settings.length) < 1e-9 * exact;
  const double width = whole ? settings.length : exact;
  const double origin = settings.begin.value_or(static_cast<double>(begin) * run.step);

  std::vector<Window> windows;
  Step last = -1;
  const auto first = static_cast<std::size_t>(
      std::lower_bound(run.steps.begin(), run.steps.end(), begin) - run.steps.begin());
  for (auto k = first; k < run.steps.size(); k += static_cast<std::size_t>(settings.stride)) {
    const Step n = (run.steps[k] - begin) / length;
    if (begin + (n + 1) * length > end) break;
    if (begin + n * length <= run.steps.front() - between) continue;  // the run begins inside it
    if (windows.empty() || n != last) {
      const auto number = static_cast<double>(n);
      windows.push_back({origin + number * width, origin + (number + 1) * width, {}});
      last = n;
    }
    windows.back().frames.push_back(k);
  }
  if (windows.empty())
    throw RunError(fmt::format(
        "no window of {:g} s is filled: frames used reach from {:.6g} s to {:.6g} s; choose a "
        "shorter --window, or another --begin and --end",
        settings.length, origin, static_cast<double>(end) * run.step));
  return windows;
}

}  // namespace grseg
