// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/fit/flow_verdict.hpp"

#include "analysis/fit/estimators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// "0.11", or "0.1 to 0.12" for several runs.
std::string range_text(const std::vector<double>& numbers)
{
  const auto [least, most] = std::ranges::minmax(numbers);
  const auto low = fmt::format("{:.2g}", least), high = fmt::format("{:.2g}", most);
  return low == high ? low : low + " to " + high;
}

/// A positive number, rounded to one significant digit.
double rounded(double number)
{
  const double power = std::pow(10, std::floor(std::log10(number)));
  return std::round(number / power) * power;
}

/// Time, s, that lies the fraction `left_out` after the begin of the earliest window.
double time_after(const FitData& data, double left_out)
{
  double begin = data.samples.front().key.begin, end = begin;
  for (const auto& sample : data.samples) {
    begin = std::min(begin, sample.key.begin);
    end = std::max(end, sample.key.end);
  }
  return begin + left_out * (end - begin);
}

/// Builds a FlowVerdict, part by part.
class Judge {
 public:
  Judge(const std::vector<FitTable>& tables, const FitData& data, const RuleFit& fit,
        const FitSettings& settings)
      : data_(data),
        fit_(fit),
        settings_(settings),
        motion_(motion_of_windows(tables, data, settings.base)),
        sums_(window_sums(fit_points(data, fit.rule, settings), data.runs)),
        small_diameter_(tables.front().species.front().diameter)
  {
  }

  FlowVerdict verdict()
  {
    judge_motion();
    if (std::ranges::any_of(data_.runs, [](std::size_t windows) { return windows < 3; }))
      say("too few windows to tell whether the motion or B is steady");
    else {
      judge_start();
      if (fit_.rule.adds_up()) judge_change();
    }
    if (fit_.rule.adds_up() && flows_steadily_) judge_width();
    return std::move(verdict_);
  }

 private:
  void say(const std::string& sentence) { verdict_.sentences.push_back(sentence); }
  void doubt(const std::string& sentence) { verdict_.doubts.push_back(sentence); }
  bool knows_speed() const { return motion_.speed.size() > 0; }
  /// Speed that rises or falls by more than `steady_within`, unless noise explains it.
  static bool accelerates(const std::optional<Change>& speed)
  {
    if (!speed) return false;
    const double mean = (speed->first + speed->last) / 2;
    return std::abs(speed->size()) > steady_within * mean &&
           (speed->is_seen() || !speed->is_known());
  }

  void judge_motion()
  {
    if (!knows_speed())
      return say("motion unknown: the tables have no velocities; grseg-stress writes them now");
    const auto speed = fmt::format("r.m.s. speed {:.2g} m/s", Series(motion_.speed).mean());
    const auto& numbers = motion_.inertial_number;
    if (numbers.empty() || !std::ranges::all_of(numbers, [](double i) { return i >= 0; }))
      return say(fmt::format("moves: {}, inertial number unknown", speed));
    const auto words = fmt::format("inertial number {}, {}", range_text(numbers), speed);
    if (std::ranges::min(numbers) >= least_inertial_number) return say("flows: " + words);
    flows_steadily_ = false;
    say("rests or creeps: " + words);
    doubt(
        fmt::format("the inertial number is below {:g}: this bed rests or creeps, and B is left "
                    "over from the way in which it came to rest",
                    least_inertial_number));
  }

  void judge_start()
  {
    const Series motion(knows_speed() ? motion_.speed
                                      : stress_ratio_of_windows(data_, settings_.base));
    double out = knows_speed() ? start_to_leave_out(motion, data_.runs, is_steady)
                               : seen_start(motion, data_.runs);
    if (out > 0.5) return say_unsteady(*change_of(motion, data_.runs));
    if (fit_.rule.adds_up()) out = std::max(out, start_of_b());
    if (!(out > 0))
      return say(knows_speed() ? "steady in these times" : "the stress is steady in these times");
    say(fmt::format("steady since t = {:.4g} s", time_after(data_, out)));
    doubt(fmt::format(
        "the start of the flow differs from the rest; --begin {:.4g} leaves it out (take "
        "this advice once: chance gives another start to one flow in twenty)",
        time_after(data_, out)));
  }

  static bool is_steady(const Series& speed, const RunLengths& runs)
  {
    const auto change = change_of(speed, runs);
    return change && !accelerates(change) && !accelerates(start_of(speed, runs));
  }

  /// Fraction of the runs in which B differs from its later values by more than the composition of
  /// the layers explains; 0 with a doubt if there is no end to it.
  double start_of_b()
  {
    const double out = seen_start(Series(sums_.excess_noise()), data_.runs);
    if (out <= 0.5) return out;
    doubt("B differs between the begin and the end of these times, whatever start is left out");
    return 0;
  }

  void say_unsteady(const Change& whole)
  {
    const auto thirds = fmt::format("from {:.3g} to {:.3g}", whole.first, whole.last);
    if (!knows_speed())
      say("not steady: the stress changes " + thirds);
    else
      say(fmt::format("{}: the speed goes {} m/s between the first and the last third of the time",
                      whole.size() > 0 ? "accelerates" : "slows down", thirds));
    flows_steadily_ = false;
    doubt(
        "the flow is not steady at any time of these tables; a longer run, and --begin, may reach "
        "its steady part");
  }

  /// The change of the height of large grains above small ones, in small diameters.
  std::string separation() const
  {
    if (motion_.height.size() == 0) return "";
    const auto height = change_of(Series(motion_.height / small_diameter_), data_.runs);
    if (std::abs(height->size()) < 0.5 || (height->is_known() && !height->is_seen())) return "";
    return fmt::format("large grains {} by {:.1f} dS against small ones",
                       height->size() > 0 ? "rise" : "sink", std::abs(height->size()));
  }

  void judge_change()
  {
    const auto moves = separation();
    if (!moves.empty()) verdict_.changes = true;
    const auto b = change_of({sums_.excess(), sums_.weight()}, data_.runs);
    if (!b->is_known())
      return say("too few windows to tell whether B changes" + (moves.empty() ? "" : "; " + moves));
    if (b->is_seen()) {
      verdict_.changes = true;
      const auto how = fmt::format(
          "B {} from {:.3f} in the first third of the time to {:.3f} in the "
          "last",
          b->size() < 0 ? "falls" : "rises", b->first, b->last);
      say((moves.empty() ? "not steady: " : "still segregating: ") + how +
          (moves.empty() ? "" : ", and " + moves));
      doubt(how +
            ": this flow has no single B, and a longer run has another; the intervals are "
            "over these times alone");
      return;
    }
    say(
        fmt::format("{}B changes by {:.3f} +- {:.3f} from the first to the last third of the time, "
                    "which may be chance",
                    moves.empty() ? "" : "still segregating, since " + moves + "; ", b->size(),
                    b->error.reach()));
  }

  /// Time or number of runs after which the interval of B has the wanted half-width.
  void judge_width()
  {
    const auto b = fit_.estimate(&Estimators::B);
    const double half = (b.high - b.low) / 2, seconds = duration();
    const bool over_runs = fit_.over == Population::runs;
    if (!over_runs && number_of_windows(data_.runs) < fewest_to_foretell) return;
    if (!(half > 0) || fit_.flow || data_.number_of_flows() > 1 ||
        !(over_runs || fit_.over == Population::windows))
      return;
    if (half <= wanted_half_width) return say(fmt::format("B is known to +- {:.3f}", half));
    const double times = times_for(half, over_runs ? 1 : 2.0 / 3);
    const auto of_runs = fmt::format(
        "{:g} such runs", rounded(std::ceil(times * static_cast<double>(data_.runs.size()))));
    say(fmt::format(
        "B +- {:g} needs about {} (an order of magnitude)", wanted_half_width,
        over_runs || verdict_.changes
            ? of_runs
            : fmt::format("{:g} s of this flow, or {}", rounded(times * seconds), of_runs)));
  }
  /// Multiple of the present data with which the half-width `half` becomes the wanted one: the
  /// error falls with its root, and the degrees of freedom grow with its `power` (of windows 2/3:
  /// correlated_windows.hpp).
  double times_for(double half, double power) const
  {
    const double error = half / StandardError{1, fit_.degrees}.reach();
    double times = 1;
    while (StandardError{error / std::sqrt(times), fit_.degrees * std::pow(times, power)}.reach() >
           wanted_half_width)
      times *= 1.02;
    return times;
  }
  /// Time of all windows, s.
  double duration() const
  {
    return data_.window * static_cast<double>(number_of_windows(data_.runs));
  }

  const FitData& data_;
  const RuleFit& fit_;
  const FitSettings& settings_;
  WindowMotion motion_;
  WindowSums sums_;
  double small_diameter_;
  bool flows_steadily_ = true;  // if not, more data of this kind would not be of a steady flow
  FlowVerdict verdict_;
};

}  // namespace

FlowVerdict verdict_on(const std::vector<FitTable>& tables, const FitData& data, const RuleFit& fit,
                       const FitSettings& settings)
{
  return Judge(tables, data, fit, settings).verdict();
}

}  // namespace grseg
