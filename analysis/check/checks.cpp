// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/checks.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {

const std::array<CheckTolerances::Option, 12>& CheckTolerances::options()
{
  using T = CheckTolerances;
  static const std::array<Option, 12> all{
      {{"round-off", &T::round_off, "deviation of quantities that hold to round-off, relative"},
       {"single-precision", &T::single_precision, "the same where the file stores float32"},
       {"mean-overlap", &T::mean_overlap, "mean overlap of the pairs that overlap, d_S"},
       {"largest-overlap", &T::largest_overlap, "largest overlap, d_S"},
       {"mean-approach", &T::mean_approach, "mean deficit of separation velocity, d_S per step"},
       {"largest-approach", &T::largest_approach, "largest such deficit, d_S per step"},
       {"false-alarm", &T::false_alarm,
        "probability that a statistical check fails by chance alone"},
       {"weight", &T::weight, "load of a layer against the weight above it, relative"},
       {"stress-ratio", &T::slope, "stress ratio of a layer against the tangent of the slope"},
       {"overlap-drift", &T::overlap_drift, "change of the mean overlap over the run, d_S"},
       {"x-drift", &T::x_drift, "mean velocity by positions less that by velocities, sqrt(g d_S)"},
       {"least-load", &T::least_load, "leave out layers with less than this part of the load"}}};
  return all;
}

const char* CheckTolerances::option_of(double CheckTolerances::*value)
{
  const auto& all = options();
  return std::find_if(all.begin(), all.end(), [&](const Option& o) { return o.value == value; })
      ->name;
}

void CheckTolerances::require_valid() const
{
  for (const auto& [name, value, meaning] : options())
    if (!(this->*value >= 0) || !std::isfinite(this->*value))
      throw UsageError(fmt::format("--{} is {}: it must be 0 or more", name, this->*value));
  if (!(false_alarm > 0) || !(false_alarm < 1))
    throw UsageError(fmt::format("--false-alarm is {}: it must lie between 0 and 1", false_alarm));
}

namespace checks {

std::string listed()
{
  std::string text;
  for (const auto& check : all)
    text += fmt::format("  {:<20} {}\n{:<23}--{}; {}\n", check.name, check.measured, "",
                        CheckTolerances::option_of(check.tolerance), check.law);
  return text;
}

}  // namespace checks

}  // namespace grseg
