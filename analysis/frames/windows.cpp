// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/windows.hpp"

#include "formats/cli/frame_range.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace grseg {
namespace {

using Step = std::int64_t;

constexpr double hole = 0.1;  // largest share of a window that may be without frames

/// Numbers of steps from each frame to the next.
std::vector<Step> gaps_of(const RunTimes& run)
{
  std::vector<Step> gaps(run.steps.size());
  std::adjacent_difference(run.steps.begin(), run.steps.end(), gaps.begin());
  gaps.erase(gaps.begin());
  return gaps;
}

/// The longest time between used frames (every `stride`-th), in steps, without holes (> `longest`).
Step between_used(const RunTimes& run, int stride, Step longest)
{
  const auto gaps = gaps_of(run);
  Step all = 0, most = gaps.empty() ? longest : 0;
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    all += std::min(gaps[k], longest);
    const auto before = static_cast<std::size_t>(stride);
    if (k >= before) all -= std::min(gaps[k - before], longest);
    most = std::max(most, all);
  }
  return most;
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
    throw FormatError(fmt::format("the run's step is {:g} s; it must be positive", run.step));
  if (settings.stride < 1) throw UsageError("--stride must be at least 1");
  if (!(settings.length > 0)) throw UsageError("--window must be positive");
}

/// Times of the windows, in steps.
struct Grid {
  Step begin = 0, end = 0, length = 0;
  Step longest = 0;  // longest time that a frame represents (longest_interval())
  Step used = 0;     // longest time between used frames

  Step begin_of(Step window) const { return begin + window * length; }
  /// True if the run has begun at step `at`. The first frame represents up to `longest` steps
  /// before it.
  bool has_begun(const RunTimes& run, Step at) const { return at > run.steps.front() - longest; }
};

/// Number of steps in a window that no frame represents, without those before the first frame.
Step empty_part(const RunTimes& run, const Grid& grid, Step window)
{
  const Step begin = grid.begin_of(window), end = begin + grid.length;
  auto next = std::ranges::upper_bound(run.steps, begin);
  Step filled = next == run.steps.begin() ? run.steps.front() : *(next - 1) + grid.longest,
       empty = 0;
  for (; next != run.steps.end() && *next < end; ++next) {
    empty += std::max<Step>(0, *next - std::max(filled, begin));
    filled = *next + grid.longest;
  }
  return empty + std::max<Step>(0, end - std::max(filled, begin));
}

bool has_hole(const RunTimes& run, const Grid& grid, Step window)
{
  return static_cast<double>(empty_part(run, grid, window)) >
         hole * static_cast<double>(grid.length);
}

/// The time of these steps in s, with as few digits as give the same number of steps when read.
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
  const bool any =
      std::ranges::any_of(run.steps, [&](Step k) { return k >= grid.begin && k < grid.end; });
  if (!any)
    throw RunError(fmt::format(
        "no frame lies between --begin and --end; the run has frames from {:.6g} s to {:.6g} s",
        seconds(run.steps.front()), seconds(run.steps.back())));
  const Step longest = grid.end - grid.begin;
  const bool fits = grid.has_begun(run, grid.begin) && longest >= grid.used &&
                    !has_hole(run, {grid.begin, grid.end, longest, grid.longest, grid.used}, 0);
  throw RunError(fmt::format(
      "no window of {:g} s is filled by frames between {:.6g} s and {:.6g} s; choose {}--window "
      "all{}",
      settings.length, seconds(grid.begin), seconds(grid.end),
      fits ? fmt::format("--window {} or ", typed(longest, run.step)) : "",
      fits ? "" : ", or another --begin and --end"));
}

Grid grid_of(const RunTimes& run, const WindowSettings& settings)
{
  Grid grid;
  grid.begin = first_step(run, settings);
  grid.longest = longest_interval(run);
  grid.end = run.steps.back() + grid.longest;
  if (settings.end) grid.end = std::min(grid.end, whole_steps(*settings.end, run.step, "--end"));
  grid.used = between_used(run, settings.stride, grid.longest);
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
              "--window '{}' is not a duration; give seconds, e.g. 1.25, or all", text));
        settings.length = number;
      });
}

std::string window_text(const WindowSettings& settings)
{
  return settings.length == all_frames ? "all" : fmt::format("{}", settings.length);
}

RunTimes times_of(const TrajectoryReader& run)
{
  const auto& parameters = run.parameters();
  // An imported run stores the mean interval between frames, which is not used here.
  const bool imported = parameters.texts.contains("import_format");
  return {run.steps(), run.step(),
          imported ? 0 : parameters.find_number("frame_interval").value_or(0)};
}

std::int64_t longest_interval(const RunTimes& run)
{
  auto gaps = gaps_of(run);
  std::ranges::sort(gaps, std::greater<>());
  const auto interval = std::llround(run.frame_interval / run.step);
  if (interval > 0) {
    const auto found = std::ranges::find_if(gaps, [&](Step g) { return g <= interval; });
    return found != gaps.end() && 2 * *found >= interval ? *found : interval;
  }
  for (std::size_t k = 0; k + 2 < gaps.size(); ++k)
    if (2 * gaps[k + 2] >= gaps[k]) return gaps[k];
  return gaps.empty() ? 1 : gaps.front();
}

Windows cut_into_windows(const RunTimes& run, const WindowSettings& settings)
{
  check(run, settings);
  const auto grid = grid_of(run, settings);
  const bool as_given = settings.begin && whole_steps(*settings.begin, run.step, "") == grid.begin;
  const double origin = as_given ? *settings.begin : static_cast<double>(grid.begin) * run.step;

  const double exact = static_cast<double>(grid.length) * run.step;
  // The length as given if it is a whole number of steps, else rounded to one.
  Windows windows{std::abs(exact - settings.length) < 1e-9 * exact ? settings.length : exact, {}};
  Step last = -1;
  bool is_filled = false;
  const auto first =
      static_cast<std::size_t>(std::ranges::lower_bound(run.steps, grid.begin) - run.steps.begin());
  for (auto k = first; k < run.steps.size(); k += static_cast<std::size_t>(settings.stride)) {
    const Step n = (run.steps[k] - grid.begin) / grid.length;
    if (grid.begin_of(n + 1) > grid.end) break;
    if (n != last) {
      last = n;
      is_filled = grid.has_begun(run, grid.begin_of(n)) &&
                  (settings.length == all_frames || !has_hole(run, grid, n));
      const auto number = static_cast<double>(n);
      if (is_filled)
        windows.list.push_back(
            {origin + number * windows.length, origin + (number + 1) * windows.length, {}});
    }
    if (is_filled) windows.list.back().frames.push_back(k);
  }
  if (windows.list.empty()) refuse_unfilled(run, settings, grid);
  return windows;
}

}  // namespace grseg
