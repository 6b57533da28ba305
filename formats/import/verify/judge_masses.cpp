// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/estimate.hpp"
#include "formats/import/verify/judge.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {
namespace {

/// Part of a judgement: no verdict where nothing can be told.
struct Part {
  Verdict verdict = Verdict::undecided;
  std::string sentence;
  double measure = 0;
};

/// The weight over the mass, of smaller grains over that of larger ones. Spheres for discs make it
/// the ratio of their sizes: what is nearer to that than to 1 is called wrong.
Part by_size(const CheckSeries& series, const CheckContext& context)
{
  if (!(context.size_ratio > 1)) return {Verdict::undecided, "all grains have one size", 0};
  const auto all = gravity_from(series, &CheckMoment::all);
  const auto smaller = gravity_from(series, &CheckMoment::smaller);
  const auto larger = gravity_from(series, &CheckMoment::larger);
  if (!all || !smaller || !larger)
    return {Verdict::undecided, "the weights of small and large grains are not known apart", 0};
  const Vec3 down = all->value.normalized();
  const double light = smaller->value.dot(down), heavy = larger->value.dot(down);
  const double ratio = light / heavy;
  const double error = std::hypot(smaller->error / light, larger->error / heavy);
  const double wrong = std::log(context.size_ratio), off = std::abs(std::log(ratio));
  const auto sentence = fmt::format(
      "the weight over the mass of smaller grains is {:.4g} times that of larger ones, "
      "with a standard error of {:.2g}",
      ratio, error);
  if (!std::isfinite(off) || !std::isfinite(error))
    return {Verdict::undecided, "the weights of small and large grains are not known apart", 0};
  if (off > wrong / 2 && off > 5 * error)
    return {Verdict::failed,
            sentence + (context.masses_are_given
                            ? ": are they discs rather than spheres, or spheres rather than discs "
                              "(--grains-are)? Or do their densities differ?"
                            : ": the masses that the archive states are not those that its grains "
                              "had"),
            std::abs(ratio - 1)};
  if (off <= wrong / 2 && 3 * error <= wrong / 2)
    return {Verdict::passed, sentence, std::abs(ratio - 1)};
  return {Verdict::undecided,
          fmt::format("{}: discs could not be told from spheres (a factor of {:.3g})", sentence,
                      context.size_ratio),
          std::abs(ratio - 1)};
}

/// Forces over accelerations where both are known.
Part by_inertia(const CheckSeries& series, const CheckContext& context)
{
  const auto slope = slope_of(sums_of(series, &CheckMoment::force));
  if (const auto change = change_of_slope(series, &CheckMoment::force))
    return {Verdict::failed,
            fmt::format("force over acceleration is {:.4g} times the mass in the first half of the "
                        "moments and {:.4g} times in the second: masses, or a unit, change within "
                        "the archive",
                        change->first.value, change->second.value),
            std::max(std::abs(change->first.value - 1), std::abs(change->second.value - 1))};
  if (!slope) return {Verdict::undecided, "force over acceleration cannot be formed", 0};
  const double off = std::abs(slope->value - 1), unsure = slope->uncertainty();
  const auto sentence = fmt::format(
      "force over acceleration is {:.4g} times the mass, with a standard error of {:.2g}",
      slope->value, slope->error);
  if (off > slope_tolerance + unsure)
    return {Verdict::failed,
            fmt::format("{}: either masses are {:.3g} times {}, or the time step is {:.3g} times "
                        "as long",
                        sentence, slope->value,
                        context.masses_are_given ? "what --density makes them"
                                                 : "those that the archive states",
                        1 / slope->value),
            off};
  if (off <= slope_tolerance && unsure <= sharp_slope) return {Verdict::passed, sentence, off};
  return {Verdict::undecided, sentence + ", which is too much to tell", off};
}

}  // namespace

Finding judge_masses(const CheckSeries& series, const CheckContext& context, const Finding& gravity)
{
  const auto relative = by_size(series, context), absolute = by_inertia(series, context);
  const bool one_size = !(context.size_ratio > 1);
  const auto& doubt = context.doubt_of_masses;
  const auto answer = [&](Verdict verdict, const std::string& sentence) {
    const double measure = std::max(relative.measure, absolute.measure);
    if (verdict == Verdict::passed && !doubt.empty())
      return Finding{"masses", Verdict::undecided, doubt, measure};
    return Finding{"masses", verdict, sentence, measure};
  };
  const bool relative_failed = relative.verdict == Verdict::failed;
  if (relative_failed && absolute.verdict == Verdict::failed)
    return answer(Verdict::failed, relative.sentence + "; " + absolute.sentence);
  if (relative_failed) return answer(Verdict::failed, relative.sentence);
  if (absolute.verdict == Verdict::failed) return answer(Verdict::failed, absolute.sentence);
  const bool relative_passed = one_size || relative.verdict == Verdict::passed;
  if (relative_passed && absolute.verdict == Verdict::passed)
    return answer(Verdict::passed,
                  one_size ? absolute.sentence : relative.sentence + "; " + absolute.sentence);
  if (!context.masses_are_given)
    return answer(Verdict::passed, "they are stated by the archive; " + relative.sentence);
  if (!relative_passed) return answer(Verdict::undecided, relative.sentence);
  if (context.has_force && gravity.verdict == Verdict::passed)
    return answer(Verdict::passed,
                  relative.sentence + "; their weight agrees with gravity as given");
  return answer(
      Verdict::undecided,
      "they come from --density, and of the archive only the weight, mass times gravity, is known: "
      "a density and a gravity that are both wrong could not be told; " +
          relative.sentence);
}

}  // namespace grseg
