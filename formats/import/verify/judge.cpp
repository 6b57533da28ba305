// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/judge.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grseg {
namespace {

double largest(const CheckSeries& series, double CheckMoment::*number)
{
  double value = 0;
  for (const auto& moment : series) value = std::max(value, moment.*number);
  return value;
}

/// A check of which each moment holds the measure: it passes up to `limit`.
Finding within(const char* check, double measure, double limit, const std::string& sentence)
{
  return {check, measure <= limit ? Verdict::passed : Verdict::failed, sentence, measure};
}

Finding judge_contacts(const CheckSeries& series)
{
  const double distance = largest(series, &CheckMoment::distance);
  const double gap = largest(series, &CheckMoment::gap);
  auto finding = within(
      "contacts", std::max(distance, gap), widest_gap,
      fmt::format("grains that bear a force on each other are up to {:.2g} of the smaller radius "
                  "apart, and {:.2g} from where the archive states",
                  gap, distance));
  if (distance > largest_distance) finding.verdict = Verdict::failed;
  return finding;
}

Finding judge_completeness(const CheckSeries& series)
{
  const double rigid = largest(series, &CheckMoment::rigid);
  if (rigid > fewest_rigid)
    return {"completeness", Verdict::failed,
            fmt::format("up to {:.2g} of the grains are parts of rigid bodies", rigid),
            rigid_bodies};
  double pairs = 0, missing = 0, may_part = 0;
  for (const auto& moment : series) {
    pairs = std::max(pairs, moment.unlisted_pairs);
    auto& deepest = moment.unlisted_may_part != 0 ? may_part : missing;
    deepest = std::max(deepest, moment.unlisted);
  }
  if (pairs == 0)
    return {"completeness", Verdict::passed, "grains that overlap are listed as contacts", 0};
  const auto sentence = fmt::format(
      "up to {:.0f} pairs of a moment overlap, by up to {:.2g} of the smaller radius, "
      "and are not listed as contacts",
      pairs, std::max(missing, may_part));
  if (missing > 0) return within("completeness", missing, 0, sentence);
  return {"completeness", Verdict::undecided,
          sentence +
              ": they may be rigid grains that part, or contacts may be missing; write forces "
              "on grains, or consecutive steps",
          may_part};
}

Finding judge_overlap(const CheckSeries& series)
{
  const double overlap = largest(series, &CheckMoment::overlap);
  return within("overlap", overlap, deepest_overlap,
                fmt::format("grains overlap by up to {:.2g} of the smaller radius", overlap));
}

Finding judge_pull(const CheckSeries& series)
{
  const double pull = largest(series, &CheckMoment::pull);
  return within("pull", pull, largest_pull,
                fmt::format("up to {:.2g} of the normal force of a moment pulls", pull));
}

std::string why_balance_is_open(const CheckSeries& series)
{
  if (series.size() < 2)
    return "a single moment has no accelerations to compare the contact forces with; write forces "
           "on grains, or several steps";
  std::vector<double> changes;
  for (std::size_t k = 1; k < series.size(); ++k) changes.push_back(series[k].change);
  const auto middle = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
  std::nth_element(changes.begin(), middle, changes.end());
  return fmt::format(
      "it cannot be judged at this interval: there are no forces on grains, and from one moment to "
      "the next the contact forces on a grain change by {:.2g} of their size, so that accelerations "
      "do not follow from velocities; write forces on grains, or consecutive steps",
      *middle);
}

Finding judge_balance(const CheckSeries& series, const CheckContext& context)
{
  double measure = 0, worst = 0, moments = 0;
  for (const auto& moment : series) {
    if (moment.balance_grains == 0) continue;
    measure = std::max(measure, moment.balance);
    worst = std::max(worst, moment.balance_worst);
    ++moments;
  }
  if (moments == 0) return {"balance", Verdict::undecided, why_balance_is_open(series), 0};
  if (measure <= context.tolerance && worst > context.tolerance)
    return {"balance", Verdict::undecided,
            fmt::format(
                "most grains balance, but {:.3g} of the largest force is missing on one: grains "
                "may have collided between two moments, or contacts with a wall are missing; "
                "write forces on grains, or consecutive steps",
                worst),
            worst};
  return within("balance", measure, context.tolerance,
                fmt::format("up to {:.3g} of the largest force is missing on a grain, at {} {}",
                            measure, moments, moments == 1 ? "moment" : "moments"));
}

}  // namespace

std::vector<Finding> judge(const CheckSeries& series, const CheckContext& context)
{
  const auto gravity = judge_gravity(series, context);
  std::vector<Finding> findings{judge_contacts(series),
                                judge_completeness(series),
                                judge_overlap(series),
                                judge_pull(series),
                                judge_balance(series, context),
                                gravity,
                                judge_masses(series, context, gravity),
                                judge_sizes(context),
                                judge_time(series, context)};
  for (auto& finding : findings) finding = context.waivers.applied_to(std::move(finding));
  return findings;
}

}  // namespace grseg
