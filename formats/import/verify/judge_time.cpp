// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/estimate.hpp"
#include "formats/import/verify/judge.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {
namespace {

Finding undecided(const CheckContext& context, const std::string& why)
{
  if (!context.step_is_given)
    return {"time", Verdict::passed, "the step is stated by the archive; " + why, 0};
  return {"time", Verdict::undecided, why, 0};
}

/// Where an archive has both, the time between its moments over the number of steps.
std::optional<Finding> by_own_times(const CheckSeries& series, const CheckContext& context)
{
  if (!context.times_are_own || !context.steps_are_own || series.size() < 2) return std::nullopt;
  const auto steps = static_cast<double>(series.back().step - series.front().step);
  const double step = (series.back().time - series.front().time) / steps;
  if (!(steps > 0) || std::abs(step / context.step - 1) < 0.01) return std::nullopt;
  return Finding{
      "time", Verdict::failed,
      fmt::format("the archive's own times suggest a step of {:.4g}; as given it is {:.4g}",
                  step / context.units.time, context.step / context.units.time),
      std::abs(step / context.step - 1)};
}

}  // namespace

Finding judge_time(const CheckSeries& series, const CheckContext& context)
{
  if (auto finding = by_own_times(series, context)) return *finding;
  const auto slope = slope_of(sums_of(series, &CheckMoment::motion));
  if (series.size() < 2)
    return undecided(context, "a single moment has no displacements to compare velocities with");
  if (!slope)
    return undecided(context,
                     "too few grains keep their velocity from one moment to the next to compare "
                     "displacements with velocities");
  if (const auto change = change_of_slope(series, &CheckMoment::motion))
    return {
        "time", Verdict::failed,
        fmt::format("displacements are {:.4g} times velocity times time in the first half of the "
                    "moments and {:.4g} times in the second: the time between moments, or a "
                    "unit, changes within the archive",
                    change->first.value, change->second.value),
        std::max(std::abs(change->first.value - 1), std::abs(change->second.value - 1))};
  const double off = std::abs(slope->value - 1), unsure = slope->uncertainty();
  const auto sentence = fmt::format(
      "displacements are {:.4g} times velocity times time, with a standard error of {:.2g}",
      slope->value, slope->error);
  if (off > slope_tolerance + unsure)
    return {
        "time", Verdict::failed,
        context.frame_interval > 0
            ? fmt::format("{}: the archive suggests --frame-interval {:.4g}; as given it is {:.4g}",
                          sentence, slope->value * context.frame_interval / context.units.time,
                          context.frame_interval / context.units.time)
        : context.times_are_own
            ? sentence + ": the times of the archive are not in the units of its velocities"
            : fmt::format("{}: the archive suggests a step of {:.4g} (--step); as given it is "
                          "{:.4g}",
                          sentence, slope->value * context.step / context.units.time,
                          context.step / context.units.time),
        off};
  if (off > slope_tolerance || unsure > sharp_slope) {
    auto finding = undecided(context, sentence + ", which is too much to tell");
    finding.measure = off;
    return finding;
  }
  if (context.step_is_given && !context.steps_are_own)
    return {"time", Verdict::undecided,
            fmt::format("{}; but the times are the archive's own, and nothing in it tells whether "
                        "a step is {:.4g}",
                        sentence, context.step / context.units.time),
            off};
  return {"time", Verdict::passed, sentence, off};
}

}  // namespace grseg
