// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/words.hpp"
#include "formats/import/common/frame_tools.hpp"
#include "formats/import/verify/check_series.hpp"
#include "formats/import/verify/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

/// An error of gravity by three degrees, as a fraction of gravity, must be detected. Deviations
/// above half of it (`tolerance`) are wrong. The standard error may be a third of the tolerance
/// (`sharp`), so that three standard errors separate the tolerance from 0 and from three degrees.
constexpr double three_degrees = 0.0523, tolerance = three_degrees / 2, sharp = tolerance / 3;

/// Smallest relative difference of gravity to report; smaller ones are round-off of --gravity.
constexpr double smallest_difference = 1e-3;

/// Smallest gravity that matters, relative to the accelerations by contacts.
constexpr double negligible = 0.01;

double degrees(double radians)
{
  return radians * 180 / std::numbers::pi;
}

Vec3 in_the_archive(const CheckContext& context, const Vec3& gravity)
{
  Vec3 vector = Vec3::Zero();
  for (int k = 0; k < 3; ++k) vector += gravity[k] * context.axes[static_cast<std::size_t>(k)];
  return vector / context.units.acceleration();
}

/// Gravity in the archive's units and axes: "9.8 along (0.391, -0.921, 0), slope 23.0 degrees".
std::string text_of(const CheckContext& context, const Vec3& gravity)
{
  const Vec3 vector = in_the_archive(context, gravity);
  const double size = vector.norm();
  if (!(size > 0)) return "0";
  const auto clean = [&](double component) {
    const double rounded = std::round(component / size * 1000) / 1000;
    return rounded == 0 ? 0 : rounded;
  };
  const double slope = std::round(10 * degrees(std::atan2(gravity.x(), -gravity.y()))) / 10;
  return fmt::format("{:.4g} along ({:g}, {:g}, {:g}), slope {:.1f} degrees", size,
                     clean(vector.x()), clean(vector.y()), clean(vector.z()),
                     slope == 0 ? 0 : slope);  // not -0.0
}

double median_acceleration(const CheckSeries& series)
{
  std::vector<double> values;
  for (const auto& frame : series) values.push_back(frame.acceleration);
  return median(values);
}

/// Possible causes of a wrong gravity, with the option that would agree with the archive.
std::string remedy(const CheckContext& context, const Estimate& estimate)
{
  const Vec3& found = estimate.value;
  const Vec3 vector = in_the_archive(context, found);
  const Vec3& given = context.gravity;
  const auto option =
      fmt::format("--gravity {:.4g},{:.4g},{:.4g}", vector.x(), vector.y(), vector.z());
  std::vector<std::string> ways{
      context.gravity_is_given
          ? fmt::format("the given gravity is wrong ({})", option)
          : fmt::format("the archive states another gravity than that of its grains ({})", option)};
  const double ratio = found.norm() / given.norm();
  // Directions are compared to within the error of the estimate, at least `sharp`.
  const double angle = std::max(sharp, 3 * estimate.error / found.norm());
  const bool same_way =
      found.dot(given) > std::cos(std::min(angle, 0.5)) * found.norm() * given.norm();
  if (same_way && std::isfinite(ratio))
    ways.push_back(fmt::format(
        "masses are {:.3g} times {}", ratio,
        context.masses_are_given ? "the masses by --density" : "the masses in the archive"));
  ways.emplace_back(estimate.medians
                        ? "a force that is not listed acts on all grains, such as a drag"
                        : "contacts with the base or a wall are missing");
  std::string text = "either ";
  for (std::size_t k = 0; k < ways.size(); ++k) text += (k > 0 ? ", or " : "") + ways[k];
  return text;
}

std::string source(const Estimate& found)
{
  const auto grains = counted(static_cast<std::size_t>(std::lround(found.grains)), "grain");
  const auto frames =
      found.medians ? counted(found.frames, "frame") : counted(found.frames, "pair") + " of frames";
  return fmt::format("from {} over {} in {}", found.medians ? "the median" : "the sum", grains,
                     frames);
}

Finding turning(const CheckSeries& series, const CheckContext& context,
                const Halves<Estimate>& halves, double scale)
{
  const auto time = [&](std::size_t k) { return series[k].time / context.units.time; };
  const auto middle = series.size() / 2;
  return {
      "gravity", Verdict::failed,
      fmt::format("gravity changes within the archive, from {} (t = {:.6g} to {:.6g}) to {} (t = "
                  "{:.6g} to {:.6g}): import the frames of one "
                  "gravity only, with --begin and --end",
                  text_of(context, halves.first.value), time(0), time(middle - 1),
                  text_of(context, halves.second.value), time(middle), time(series.size() - 1)),
      (halves.second.value - halves.first.value).norm() / scale};
}

Finding undecided_gravity(const CheckContext& context, const std::string& why)
{
  if (!context.gravity_is_given)
    return {"gravity", Verdict::passed, "it is stated by the archive; " + why, 0};
  return {"gravity", Verdict::undecided, why, 0};
}

/// Says why gravity is wrong by orders of magnitude, which a single frame shows: the contacts of a
/// grain in a bed carry at least its own weight, and at most the layers above it. "" if it may be right.
std::string absurd(const CheckSeries& series, const CheckContext& context)
{
  constexpr double lightest = 0.01, heaviest = 1e6;
  const double carried = median_acceleration(series) / context.gravity.norm();
  if (!(carried > 0) || !std::isfinite(carried) || (carried >= lightest && carried <= heaviest))
    return "";
  return fmt::format(
      "gravity as given, {}, cannot be right for a bed: the contacts of a grain carry {:.2g} times its "
      "weight (median), {}; check --gravity, --units and {}",
      text_of(context, context.gravity), carried,
      carried < lightest ? "so it would fall through them" : "as under a million layers of grains",
      context.masses_are_given ? "--density" : "the masses in the archive");
}

/// A finding of one of the two methods that check the masses.
Finding part(Verdict verdict, const std::string& sentence, double measure = 0)
{
  return {"masses", verdict, sentence, measure};
}

/// Compares weight over mass between smaller and larger grains: the ratio should be 1. If spheres
/// are taken for discs, it is the ratio of sizes; a value nearer to that than to 1 is wrong.
Finding by_size(const CheckSeries& series, const CheckContext& context)
{
  if (!(context.size_ratio > 1)) return part(Verdict::undecided, "all grains have one size");
  const auto all = gravity_from(series, &CheckNumbers::all);
  const auto smaller = gravity_from(series, &CheckNumbers::smaller);
  const auto larger = gravity_from(series, &CheckNumbers::larger);
  if (!all || !smaller || !larger)
    return part(Verdict::undecided, "the weights of small and large grains are not known apart");
  const Vec3 down = all->value.normalized();
  const double light = smaller->value.dot(down), heavy = larger->value.dot(down);
  const double ratio = light / heavy;
  const double error = std::hypot(smaller->error / light, larger->error / heavy);
  const double wrong = std::log(context.size_ratio), off = std::abs(std::log(ratio));
  const auto sentence = fmt::format(
      "weight over mass of smaller grains is {:.4g} times that of larger ones, "
      "with a standard error of {:.2g}",
      ratio, error);
  if (!std::isfinite(off) || !std::isfinite(error))
    return part(Verdict::undecided, "the weights of small and large grains are not known apart");
  if (off > wrong / 2 && off > 5 * error)
    return part(
        Verdict::failed,
        sentence + (context.masses_are_given
                        ? ": are they discs rather than spheres, or spheres rather than discs "
                          "(--grains-are)? Or do their densities differ?"
                        : ": the masses of the archive do not fit its radii and forces"),
        std::abs(ratio - 1));
  if (off <= wrong / 2 && 3 * error <= wrong / 2)
    return part(Verdict::passed, sentence, std::abs(ratio - 1));
  return part(Verdict::undecided,
              fmt::format("{}: too inaccurate to distinguish discs "
                          "from spheres (a factor of {:.3g})",
                          sentence, context.size_ratio),
              std::abs(ratio - 1));
}

/// Compares force over acceleration with the mass, for grains with a known acceleration.
Finding by_inertia(const CheckSeries& series, const CheckContext& context)
{
  const auto slope = slope_of(sums_of(series, &CheckNumbers::force));
  if (const auto change = change_of_slope(series, &CheckNumbers::force))
    return part(
        Verdict::failed,
        fmt::format("force over acceleration is {:.4g} times the mass in the first half of the "
                    "frames and {:.4g} times in the second: masses, or a unit, change within "
                    "the archive",
                    change->first.value, change->second.value),
        std::max(std::abs(change->first.value - 1), std::abs(change->second.value - 1)));
  if (!slope) return part(Verdict::undecided, "force over acceleration cannot be computed");
  const double off = std::abs(slope->value - 1), unsure = slope->uncertainty();
  const auto sentence = "force over acceleration is " + in_words(*slope, "the mass");
  if (off > slope_tolerance + unsure)
    return part(
        Verdict::failed,
        fmt::format(
            "{}: either masses are {:.3g} times {}, or the time step is {:.3g} times "
            "as long",
            sentence, slope->value,
            context.masses_are_given ? "the masses by --density" : "the masses in the archive",
            1 / slope->value),
        off);
  if (off <= slope_tolerance && unsure <= sharp_slope) return part(Verdict::passed, sentence, off);
  return part(Verdict::undecided, sentence + ": " + why_undecided(*slope), off);
}

}  // namespace

Finding judge_gravity(const CheckSeries& series, const CheckContext& context)
{
  const auto found = gravity_from(series, &CheckNumbers::all);
  const auto why_absurd = absurd(series, context);
  if (!found && !why_absurd.empty()) return {"gravity", Verdict::failed, why_absurd, 1};
  if (!found)
    return undecided_gravity(
        context, fmt::format("without forces on grains, an estimate of gravity needs {} pairs of "
                             "frames, or frames close together",
                             fewest_pairs));
  const double scale = std::max(
      {context.gravity.norm(), found->value.norm(), negligible * median_acceleration(series)});
  if (!(scale > 0))
    return {"gravity", Verdict::passed, "gravity is 0, as given and by the motion of the grains",
            0};
  if (const auto change = change_of_gravity(series, tolerance * scale))
    return turning(series, context, *change, scale);
  const double measure = (found->value - context.gravity).norm() / scale;
  const double error = found->error / scale;
  const auto suggestion =
      fmt::format("the archive suggests gravity {}, with a standard error of {:.2g} of it, {}",
                  text_of(context, found->value), error, source(*found));
  if (measure > tolerance && measure > 5 * error)
    return {"gravity", Verdict::failed,
            fmt::format("{}; as given it is {}: {}", suggestion, text_of(context, context.gravity),
                        remedy(context, *found)),
            measure};
  if (measure <= tolerance && error <= sharp && context.gravity.y() > 0)
    return {"gravity", Verdict::failed,
            suggestion + ", which points away from the base: name the axes of the flow with --axes",
            1 + context.gravity.y() / context.gravity.norm()};
  if (measure <= tolerance && error <= sharp) {
    const bool differs = measure > 5 * error && measure > smallest_difference;
    return {"gravity", Verdict::passed,
            suggestion +
                (differs ? "; as given it is " + text_of(context, context.gravity) : std::string()),
            measure};
  }
  if (!why_absurd.empty()) return {"gravity", Verdict::failed, why_absurd, measure};
  auto finding =
      undecided_gravity(context, suggestion + ": an error of 3 degrees would not be detected");
  finding.measure = measure;
  return finding;
}

Finding judge_masses(const CheckSeries& series, const CheckContext& context, const Finding& gravity)
{
  const auto relative = by_size(series, context), absolute = by_inertia(series, context);
  const bool one_size = !(context.size_ratio > 1);
  const auto answer = [&](Verdict verdict, const std::string& sentence) {
    const bool doubt = verdict == Verdict::passed && !context.doubt_of_masses.empty();
    return part(doubt ? Verdict::undecided : verdict, doubt ? context.doubt_of_masses : sentence,
                std::max(relative.measure, absolute.measure));
  };
  const auto both = relative.sentence + "; " + absolute.sentence;
  const bool fails = relative.verdict == Verdict::failed;
  if (fails || absolute.verdict == Verdict::failed)
    return answer(Verdict::failed, !fails                                ? absolute.sentence
                                   : absolute.verdict == Verdict::failed ? both
                                                                         : relative.sentence);
  const bool passes = one_size || relative.verdict == Verdict::passed;
  if (passes && absolute.verdict == Verdict::passed)
    return answer(Verdict::passed, one_size ? absolute.sentence : both);
  if (!context.masses_are_given)
    return answer(Verdict::passed, "they are stated by the archive; " + relative.sentence);
  if (!passes) return answer(Verdict::undecided, relative.sentence);
  if (context.has_force && gravity.verdict == Verdict::passed)
    return answer(Verdict::passed,
                  relative.sentence + "; their weight agrees with gravity as given");
  return answer(
      Verdict::undecided,
      "they come from --density, and the archive shows only the weight, mass times gravity: errors "
      "of density and gravity that cancel would not be detected; " +
          relative.sentence);
}

}  // namespace grseg
