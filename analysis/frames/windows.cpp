// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/windows.hpp"

#include "formats/cli/frame_range.hpp"
#include "formats/cli/numbers.hpp"
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

/// Where windows lie, in steps.
struct Grid {
  Step begin = 0, end = 0, length = 0;
  Step used = 0;  // between the frames that are used

  /// True where the run has begun when the first window does.
  bool begins_in(const RunTimes& run) const { return begin > run.steps.front() - spacing(run); }
};

/// As few digits of a time as give these steps again.
std::string typed(Step steps, double step)
{
  const double time = static_cast<double>(steps) * step;
  for (int digits = 3;; ++digits) {
    auto text = fmt::format("{:.{}g}", time, digits);
    if (digits == 17 || whole_steps(std::stod(text), step, "") == steps) return text;
  }
}

[[noreturn]] void refuse_unfilled(const RunTimes& run, const WindowSettings& settings,
                                  const Grid& grid)
{
  const auto seconds = [&](Step steps) { return static_cast<double>(steps) * run.step; };
  const bool any = std::any_of(run.steps.begin(), run.steps.end(),
                               [&](Step k) { return k >= grid.begin && k < grid.end; });
  if (!any)
    throw RunError(fmt::format(
        "no frame lies between --begin and --end; the run goes from {:.6g} s to {:.6g} s",
        seconds(run.steps.front()), seconds(run.steps.back())));
  const Step longest = grid.end - grid.begin;
  const bool fits = grid.begins_in(run) && longest >= grid.used;
  throw RunError(fmt::format(
      "no window of {:g} s is filled: frames used reach from {:.6g} s to {:.6g} s; choose {}--window "
      "all{}",
      settings.length, seconds(grid.begin), seconds(grid.end),
      fits ? fmt::format("--window {} or ", typed(longest, run.step)) : "",
      fits ? "" : ", or another --begin and --end"));
}

Grid grid_of(const RunTimes& run, const WindowSettings& settings)
{
  Grid grid;
  grid.begin = first_step(run, settings);
  grid.end = run.steps.back() + spacing(run);
  if (settings.end) grid.end = std::min(grid.end, whole_steps(*settings.end, run.step, "--end"));
  grid.used = spacing(run) * settings.stride;
  if (settings.length == all_frames) {
    grid.begin = std::max(grid.begin, run.steps.front());
    grid.length = grid.end - grid.begin;
    if (grid.length <= 0) refuse_unfilled(run, settings, grid);
    return grid;
  }
  grid.length = whole_steps(settings.length, run.step, "--window");
  if (grid.length < grid.used)
    throw UsageError(fmt::format(
        "--window {:g} s is shorter than the {:g} s between the frames used; choose --window {} or "
        "longer, or --window all",
        settings.length, static_cast<double>(grid.used) * run.step, typed(grid.used, run.step)));
  return grid;
}

/// As it was given where that is a whole number of steps.
double length_of(const RunTimes& run, const WindowSettings& settings, const Grid& grid)
{
  const double exact = static_cast<double>(grid.length) * run.step;
  return std::abs(exact - settings.length) < 1e-9 * exact ? settings.length : exact;
}

}  // namespace

po::typed_value<std::string>* window_option(WindowSettings& settings)
{
  return po::value<std::string>()
      ->default_value(window_text(settings))
      ->value_name("s")
      ->notifier([&settings](const std::string& text) {
        const auto number = text == "all" ? all_frames : parse_number(text).value_or(0);
        if (!(number > 0) || (std::isinf(number) && text != "all"))
          throw UsageError(fmt::format(
              "--window '{}' is not a length of time: give seconds, as in 1.25, or all", text));
        settings.length = number;
      });
}

std::string window_text(const WindowSettings& settings)
{
  return settings.length == all_frames ? "all" : fmt::format("{}", settings.length);
}

Windows cut_into_windows(const RunTimes& run, const WindowSettings& settings)
{
  check(run, settings);
  const auto grid = grid_of(run, settings);
  const bool as_given = settings.begin && whole_steps(*settings.begin, run.step, "") == grid.begin;
  const double origin = as_given ? *settings.begin : static_cast<double>(grid.begin) * run.step;

  Windows windows{length_of(run, settings, grid), {}};
  Step last = -1;
  const auto first = static_cast<std::size_t>(
      std::lower_bound(run.steps.begin(), run.steps.end(), grid.begin) - run.steps.begin());
  for (auto k = first; k < run.steps.size(); k += static_cast<std::size_t>(settings.stride)) {
    const Step n = (run.steps[k] - grid.begin) / grid.length;
    if (grid.begin + (n + 1) * grid.length > grid.end) break;
    if (grid.begin + n * grid.length <= run.steps.front() - spacing(run))
      continue;  // the run begins inside it
    if (windows.list.empty() || n != last) {
      const auto number = static_cast<double>(n);
      windows.list.push_back(
          {origin + number * windows.length, origin + (number + 1) * windows.length, {}});
      last = n;
    }
    windows.list.back().frames.push_back(k);
  }
  if (windows.list.empty()) refuse_unfilled(run, settings, grid);
  return windows;
}

}  // namespace grseg
