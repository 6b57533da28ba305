// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/judge.hpp"

#include "formats/cli/words.hpp"
#include "formats/import/common/frame_tools.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

double largest(const CheckSeries& series, double CheckNumbers::*number)
{
  double value = 0;
  for (const auto& frame : series) value = std::max(value, frame.*number);
  return value;
}

/// Finding of a check that passes if `measure` is at most `limit`.
Finding within(const char* check, double measure, double limit, const std::string& sentence)
{
  return {check, measure <= limit ? Verdict::passed : Verdict::failed,
          limit > 0 ? fmt::format("{} (limit: {:g})", sentence, limit) : sentence, measure};
}

Finding judge_contacts(const CheckSeries& series)
{
  const double distance = largest(series, &CheckNumbers::distance);
  const double gap = largest(series, &CheckNumbers::gap);
  const bool passes = gap <= widest_gap && distance <= largest_distance;
  return {
      "contacts", passes ? Verdict::passed : Verdict::failed,
      fmt::format("grains that exert a force on each other are up to {:.2g} of the smaller radius "
                  "apart (limit: {:g}), and their distances differ by up to {:.2g} (limit: {:g}) "
                  "from the distances that the archive states",
                  gap, widest_gap, distance, largest_distance),
      std::max(distance, gap)};
}

Finding judge_completeness(const CheckSeries& series)
{
  const double rigid = largest(series, &CheckNumbers::rigid);
  if (rigid > fewest_rigid)
    return {"completeness", Verdict::failed,
            fmt::format("up to {:.2g} of the grains are parts of rigid bodies", rigid),
            rigid_bodies};
  double pairs = 0, missing = 0, may_part = 0;
  for (const auto& frame : series) {
    pairs = std::max(pairs, frame.unlisted_pairs);
    auto& deepest = frame.unlisted_may_part != 0 ? may_part : missing;
    deepest = std::max(deepest, frame.unlisted);
  }
  if (pairs == 0)
    return {"completeness", Verdict::passed, "grains that overlap are listed as contacts", 0};
  const auto sentence = fmt::format(
      "up to {} of a frame overlap{}, by up to {:.2g} of the smaller radius, without being listed "
      "as {}",
      counted(static_cast<std::size_t>(pairs), "pair"), pairs == 1 ? "s" : "",
      std::max(missing, may_part), pairs == 1 ? "a contact" : "contacts");
  if (missing > 0) return within("completeness", missing, 0, sentence);
  return {"completeness", Verdict::undecided,
          sentence +
              ": they may be rigid grains that separate, or contacts may be missing; write forces "
              "on grains, or consecutive steps",
          may_part};
}

std::string why_balance_is_open(const CheckSeries& series)
{
  if (series.size() < 2)
    return "a single frame has no accelerations to compare the contact forces with; write forces "
           "on grains, or several steps";
  std::vector<double> changes;
  for (std::size_t k = 1; k < series.size(); ++k) changes.push_back(series[k].change);
  return fmt::format(
      "it cannot be judged at this interval between frames: the archive has no forces on grains, "
      "and from one frame to the next the contact forces on a grain change by {:.2g} of their "
      "size, so that accelerations do not follow from velocities; "
      "write forces on grains, or consecutive steps",
      median(changes));
}

Finding judge_balance(const CheckSeries& series, const CheckContext& context)
{
  double measure = 0, worst = 0, frames = 0;
  for (const auto& frame : series) {
    if (frame.balance_grains == 0) continue;
    measure = std::max(measure, frame.balance);
    worst = std::max(worst, frame.balance_worst);
    ++frames;
  }
  if (frames == 0) return {"balance", Verdict::undecided, why_balance_is_open(series), 0};
  if (measure <= context.tolerance && worst > context.tolerance)
    return {"balance", Verdict::undecided,
            fmt::format(
                "most grains balance, but {:.3g} of the largest force is missing on one: grains "
                "may have collided between two frames, or contacts with a wall are missing; "
                "write forces on grains, or consecutive steps",
                worst),
            worst};
  return within("balance", measure, context.tolerance,
                fmt::format("up to {:.3g} of the largest force is missing on a grain, in {} {}",
                            measure, frames, frames == 1 ? "frame" : "frames"));
}

/// Largest factor by which a nominal diameter may differ from the nearest diameter of its grains.
constexpr double largest_factor = 1.5;

std::string named(const SpeciesSizes& species)
{
  return species.types.empty() ? species.name
                               : fmt::format("{} (types {})", species.name, species.types);
}

Finding failed(const std::string& sentence, double measure)
{
  return {"sizes", Verdict::failed, sentence, measure};
}

std::string exchange(const SpeciesSizes& lower, const SpeciesSizes& upper)
{
  if (lower.types.empty() || upper.types.empty()) return "exchange them";
  return fmt::format("exchange them, --small {} --large {}", upper.types, lower.types);
}

Finding undecided_time(const CheckContext& context, const std::string& why)
{
  if (!context.step_is_given)
    return {"time", Verdict::passed, "the step is stated by the archive; " + why, 0};
  return {"time", Verdict::undecided, why, 0};
}

/// Compares the step with the time between frames over the number of steps, if the archive states
/// times and steps; a finding only if they differ.
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

std::vector<Finding> judge(const CheckSeries& series, const CheckContext& context)
{
  const auto gravity = judge_gravity(series, context);
  const double overlap = largest(series, &CheckNumbers::overlap);
  const double pull = largest(series, &CheckNumbers::pull);
  std::vector<Finding> findings{
      judge_contacts(series),
      judge_completeness(series),
      within("overlap", overlap, deepest_overlap,
             fmt::format("grains overlap by up to {:.2g} of the smaller radius", overlap)),
      within("pull", pull, largest_pull,
             fmt::format("up to {:.2g} of the normal force of a frame is attractive", pull)),
      judge_balance(series, context),
      gravity,
      judge_masses(series, context, gravity),
      judge_sizes(context),
      judge_time(series, context)};
  for (auto& finding : findings) finding = context.waivers.applied_to(std::move(finding));
  return findings;
}

Finding judge_sizes(const CheckContext& context)
{
  const auto& all = context.species;
  const double length = context.units.length;
  for (const auto& species : all) {
    const double factor =
        std::max(species.smallest / species.nominal, species.nominal / species.largest);
    if (species.nominal > 0 && factor > largest_factor)
      return failed(
          fmt::format(
              "the nominal diameter of {}, {:.4g}, is far from the diameters of its grains, "
              "{:.4g} to {:.4g}: does it belong to another species, or is it in other units?",
              named(species), species.nominal / length, species.smallest / length,
              species.largest / length),
          factor - 1);
  }
  for (std::size_t k = 0; k + 1 < all.size(); ++k)
    if (!(all[k].mean < all[k + 1].mean))
      return failed(fmt::format("the mean diameter of {} is {:.4g}, and of {} {:.4g}: {}",
                                named(all[k]), all[k].mean / length, named(all[k + 1]),
                                all[k + 1].mean / length, exchange(all[k], all[k + 1])),
                    all[k].mean / all[k + 1].mean - 1);
  for (std::size_t k = 0; k + 1 < all.size(); ++k)
    if (all[k].nominal > all[k + 1].nominal)
      return failed(fmt::format("the nominal diameter of {} is {:.4g}, and of {} {:.4g}: "
                                "exchange the two diameters",
                                named(all[k]), all[k].nominal / length, named(all[k + 1]),
                                all[k + 1].nominal / length),
                    all[k].nominal / all[k + 1].nominal - 1);
  std::string sentence = "mean diameters are";
  for (const auto& species : all)
    sentence += fmt::format("{} {:.4g} ({})", &species == &all.front() ? "" : ",",
                            species.mean / length, species.name);
  return {"sizes", Verdict::passed, sentence, 0};
}

Finding judge_time(const CheckSeries& series, const CheckContext& context)
{
  if (auto finding = by_own_times(series, context)) return *finding;
  const auto slope = slope_of(sums_of(series, &CheckNumbers::motion));
  if (series.size() < 2)
    return undecided_time(context,
                          "a single frame has no displacements to compare velocities with");
  if (!slope)
    return undecided_time(
        context,
        "too few grains have a steady velocity from one frame to the next to compare "
        "displacements with velocities");
  if (const auto change = change_of_slope(series, &CheckNumbers::motion))
    return {
        "time", Verdict::failed,
        fmt::format("displacements are {:.4g} times velocity times time in the first half of the "
                    "frames and {:.4g} times in the second: the time between frames, or a "
                    "unit, changes within the archive",
                    change->first.value, change->second.value),
        std::max(std::abs(change->first.value - 1), std::abs(change->second.value - 1))};
  const double off = std::abs(slope->value - 1), unsure = slope->uncertainty();
  const auto sentence = "displacements are " + in_words(*slope, "velocity times time");
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
    auto finding = undecided_time(context, sentence + ": " + why_undecided(*slope));
    finding.measure = off;
    return finding;
  }
  if (context.step_is_given && !context.steps_are_own)
    return {"time", Verdict::undecided,
            fmt::format("{}; but the archive states times and no steps, so "
                        "a step of {:.4g} cannot be checked",
                        sentence, context.step / context.units.time),
            off};
  return {"time", Verdict::passed, sentence, off};
}

}  // namespace grseg
