// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/physics_check.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace grseg {
namespace {

// The last window only ends the one before it, and errors take three.
constexpr std::size_t least_windows = 4;
constexpr const char* few_windows = "fewer than four windows";

std::optional<double> number_of(const TrajectoryReader& run, const std::string& name)
{
  const auto found = run.parameters().numbers.find(name);
  if (found == run.parameters().numbers.end() || found->second.size() != 1) return {};
  return found->second[0];
}

/// The contact law by its name in /parameters/contact_law; runs that tell none touch first.
ContactRules rules_of(const TrajectoryReader& run)
{
  ContactRules rules;
  rules.friction = number_of(run, "friction");
  rules.restitution = number_of(run, "restitution");
  rules.step = run.step();
  const auto& radius = run.grains().radius;
  rules.margin = 1e-9 * 2 * *std::min_element(radius.begin(), radius.end());
  const auto law = run.parameters().text("contact_law");
  if (law == "centred") rules.look_ahead = 0.5;
  if (law == "predictive") rules.look_ahead = 1;
  if (law == "speculative") {
    rules.look_ahead = rules.horizon = run.parameters().number("horizon", run.path());
    // Of files that do not tell it.
    const double by_gravity =
        rules.horizon * rules.step * std::sqrt(run.gravity().norm() * run.small_diameter());
    rules.margin = std::max(rules.margin, number_of(run, "contact_margin").value_or(by_gravity));
  }
  return rules;
}

Layers layers_of(const TrajectoryReader& run, const std::string& layer)
{
  return {parse_length(layer, "--layer", {run.small_diameter(), run.large_diameter()}),
          run.box().length_x};
}

double first_time(const TrajectoryReader& run, const WindowSettings& settings)
{
  constexpr double from_the_tilt = 0;
  if (settings.begin) return *settings.begin;
  const bool only_before = run.size() > 0 && run.times().back() < from_the_tilt;
  return only_before ? run.times().front() : from_the_tilt;
}

std::vector<double> observable_of(const TrajectoryReader& run, const std::string& name)
{
  return run.has_observable(name) ? run.observable(name) : std::vector<double>{};
}

/// By frame; empty where the run does not tell.
std::vector<Vec2> base_force_of(const TrajectoryReader& run)
{
  const auto x = observable_of(run, "base_force_x"), y = observable_of(run, "base_force_y");
  std::vector<Vec2> force;
  for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k) force.emplace_back(x[k], y[k]);
  return force;
}

CheckLine skipped(const std::string& quantity, const std::string& why)
{
  CheckLine line;
  line.quantity = quantity;
  line.remark = why;
  return line;
}

CheckLine bounded(const std::string& quantity, double measured, double tolerance,
                  const std::string& remark)
{
  CheckLine line;
  line.quantity = quantity;
  line.measured = measured;
  line.tolerance = tolerance;
  line.verdict = measured <= tolerance ? Verdict::passed : Verdict::failed;
  line.remark = remark;
  return line;
}

std::string place_of(const WorstCase& worst, const std::string& what)
{
  if (worst.count == 0) return "there is none";
  if (worst.largest == 0) return "";
  const auto at = fmt::format("at t = {:.6g} s", worst.time);
  return what.empty() ? at : fmt::format("{}, {} {}", at, what, worst.number);
}

/// Slope and its error of a straight line through `values`, times the time they reach over.
std::pair<double, double> change_over(const std::vector<double>& times,
                                      const std::vector<double>& values)
{
  double constant = 0, slope = 0, c00 = 0, c01 = 0, c11 = 0, squares = 0;
  gsl_fit_linear(times.data(), 1, values.data(), 1, times.size(), &constant, &slope, &c00, &c01,
                 &c11, &squares);
  const double span = times.back() - times.front();
  return {slope * span, std::sqrt(std::max(0.0, c11)) * span};
}

}  // namespace

const std::array<CheckTolerances::Named, 12>& CheckTolerances::all()
{
  using T = CheckTolerances;
  static const std::array<Named, 12> names{
      {{"round-off", &T::round_off, "of what holds to round-off, relative"},
       {"single-precision", &T::single_precision, "the same where the file stores float32"},
       {"mean-overlap", &T::mean_overlap, "mean overlap of pairs that overlap, d_S"},
       {"largest-overlap", &T::largest_overlap, "largest overlap, d_S"},
       {"mean-approach", &T::mean_approach, "mean separation that is lacking, d_S per step"},
       {"largest-approach", &T::largest_approach, "largest, likewise"},
       {"false-alarm", &T::false_alarm, "probability that chance alone fails a statistical line"},
       {"weight", &T::weight, "what a layer carries against the weight above, relative"},
       {"slope", &T::slope, "its stress ratio against the tangent of the slope"},
       {"overlap-drift", &T::overlap_drift, "change of the mean overlap over the run, d_S"},
       {"x-drift", &T::x_drift, "mean way against mean velocity, sqrt(g d_S)"},
       {"least-load", &T::least_load,
        "layers that carry less than this part of the load are left out"}}};
  return names;
}

void CheckTolerances::require_sense() const
{
  for (const auto& [name, value, meaning] : all())
    if (!(this->*value >= 0) || !std::isfinite(this->*value))
      throw UsageError(fmt::format("--{} is {}: it must be 0 or more", name, this->*value));
  if (!(false_alarm > 0) || !(false_alarm < 1))
    throw UsageError(fmt::format("--false-alarm is {}: it must lie between 0 and 1", false_alarm));
}

PhysicsCheck::PhysicsCheck(const TrajectoryReader& run, const PhysicsSettings& settings)
    : run_(run),
      tolerances_(settings.tolerances),
      gravity_(run.gravity()),
      small_diameter_(run.small_diameter()),
      rules_(rules_of(run)),
      rotation_(number_of(run, "rotation").value_or(1) != 0),
      layers_(layers_of(run, settings.layer)),
      begin_(first_time(run, settings.windows)),
      end_(settings.windows.end.value_or(std::numeric_limits<double>::infinity())),
      forces_(gravity_, run.step()),
      motion_(gravity_, run.step()),
      partials_(run.box()),
      contacts_(rules_),
      base_force_(base_force_of(run)),
      energy_defect_(observable_of(run, "energy_defect"))
{
  tolerances_.require_sense();
  try {
    windows_ = cut_into_windows(
        {run.steps(), run.step(), number_of(run, "frame_interval").value_or(0)}, settings.windows);
  } catch (const RunError&) {
    // Too short a run for a window is one for lines that need none.
  }
}

bool PhysicsCheck::in_window(std::size_t index) const
{
  return window_ < windows_.size() && index >= windows_[window_].frames.front();
}

/// Whether gravity presses on the base, always in one direction.
bool PhysicsCheck::steady_slope() const
{
  return gravity_.start.y() < 0 && !gravity_.turns();
}

/// Whether the energies are so small that what is missing of them is round-off of the forces.
bool PhysicsCheck::at_rest(const TotalMotion& total) const
{
  constexpr double least = 1e-12;
  return total.energy < least * total.mass * gravity_.norm() * small_diameter_;
}

void PhysicsCheck::add(std::size_t index, const Frame& frame)
{
  if (frame.time < begin_ || frame.time >= end_) return;
  const auto& grains = run_.grains();
  std::optional<Vec2> base;
  if (!base_force_.empty()) base = base_force_[index];
  const auto total = total_motion(grains, frame, run_.box());
  motion_.add(total, base);
  if (in_window(index) && windows_[window_].frames.front() == index) begin_window(frame);
  has_force_ = has_force_ && !frame.force.empty();
  forces_.add(grains, frame);
  partials_.add(grains, frame);
  contacts_.add(grains, frame);
  if (!energy_defect_.empty())
    energy_.add(at_rest(total) ? 0 : energy_defect_[index], frame.time, 0);
  if (!in_window(index)) return;
  if (weights_) weights_->add_to_mean(grains, frame);
  if (windows_[window_].frames.back() == index) end_window();
}

void PhysicsCheck::begin_window(const Frame& frame)
{
  const auto& overlap = contacts_.overlap();
  marks_.push_back(
      {frame.time, motion_.stray(), overlap.sum, overlap.count, energy_.sum, energy_.count});
  if (steady_slope() && run_.box().periodic_x)
    weights_.emplace(layers_, gravity_.start, small_diameter_ / 2);
}

/// The mean velocity is known now, so that fluctuations can be counted from it.
void PhysicsCheck::end_window()
{
  if (weights_) {
    Frame frame;
    for (const std::size_t k : windows_[window_].frames) {
      run_.read(k, frame, {.velocity = true, .contacts = true});
      weights_->add(run_.grains(), frame);
    }
    weight_windows_.push_back(weights_->window());
    weights_.reset();
  }
  ++window_;
}

std::vector<CheckLine> PhysicsCheck::lines() const
{
  std::vector<CheckLine> lines;
  if (motion_.frames() == 0) return {skipped("physics", "no frame between --begin and --end")};
  add_balances(lines);
  add_contacts(lines);
  add_layers(lines);
  add_drifts(lines);
  return lines;
}

CheckLine PhysicsCheck::exact(const std::string& quantity, const WorstCase& worst,
                              const std::string& what) const
{
  const bool rounded = run_.stores_float32();
  return bounded(quantity, worst.largest,
                 rounded ? tolerances_.single_precision : tolerances_.round_off,
                 place_of(worst, what));
}

CheckLine PhysicsCheck::statistical(const std::string& quantity, double deviation, double error,
                                    double allowed, std::size_t windows, std::size_t together) const
{
  const double tail = tolerances_.false_alarm / 2 / static_cast<double>(together);
  const double quantile = gsl_cdf_tdist_Qinv(tail, static_cast<double>(windows) - 1);
  auto line = bounded(quantity, std::abs(deviation), std::max(allowed, quantile * error), "");
  line.error = error;
  return line;
}

void PhysicsCheck::add_balances(std::vector<CheckLine>& lines) const
{
  const char* no_force = "the file holds no `force` of grains";
  const auto& torques = forces_.torques();
  lines.push_back(has_force_ ? exact("force_balance", forces_.forces(), "grain")
                             : skipped("force_balance", no_force));
  if (!rotation_)
    lines.push_back(skipped("torque_balance", "grains do not rotate"));
  else
    lines.push_back(torques.count > 0
                        ? exact("torque_balance", torques, "grain")
                        : skipped("torque_balance", "no two frames are consecutive steps"));
  lines.push_back(
      motion_.momentum().count > 0
          ? exact("total_momentum", motion_.momentum(), "")
          : skipped("total_momentum", base_force_.empty()
                                          ? "the file holds no /observables/base_force_x, _y"
                                          : "there is one frame only"));
  lines.push_back(exact("sum_of_partials", partials_.defect(), ""));
  lines.push_back(energy_.count > 0
                      ? exact("energy_defect", energy_, "")
                      : skipped("energy_defect", "the file holds no /observables/energy_defect"));
}

void PhysicsCheck::add_contacts(std::vector<CheckLine>& lines) const
{
  const auto both = [&](const std::string& name, const WorstCase& worst, double unit,
                        double largest, double mean) {
    lines.push_back(
        bounded(name + "_largest", worst.largest / unit, largest, place_of(worst, "contact")));
    lines.push_back(bounded(name + "_mean", worst.mean() / unit, mean, ""));
  };
  const auto skip = [&](const std::string& name, const char* why) {
    lines.push_back(skipped(name + "_largest", why));
    lines.push_back(skipped(name + "_mean", why));
  };
  const double round = run_.stores_float32() ? tolerances_.single_precision : tolerances_.round_off;
  if (rules_.friction)
    both("coulomb", contacts_.coulomb(), 1, round, round);
  else
    skip("coulomb", "the file holds no /parameters/friction");
  both("tension", contacts_.tension(), 1, round, round);
  const char* no_force = "the file holds no `force` of grains, so no velocities before the step";
  if (has_force_)
    both("open_gap", contacts_.open_gap(), small_diameter_, round, round);
  else
    skip("open_gap", no_force);
  if (has_force_ && rules_.restitution)
    both("approach", contacts_.approach(), small_diameter_, tolerances_.largest_approach,
         tolerances_.mean_approach);
  else
    skip("approach", has_force_ ? "the file holds no /parameters/restitution" : no_force);
  both("overlap", contacts_.overlap(), small_diameter_, tolerances_.largest_overlap,
       tolerances_.mean_overlap);
}

void PhysicsCheck::add_layers(std::vector<CheckLine>& lines) const
{
  std::string why = windows_.size() < least_windows ? few_windows : "";
  if (!run_.box().periodic_x) why = "the cell is not periodic, so that walls carry a part";
  if (!(gravity_.start.y() < 0)) why = "gravity does not press on the base";
  if (gravity_.turns()) why = "the slope turns, so no window has one";
  const auto balances = why.empty()
                            ? balance_layers(weight_windows_, layers_, tolerances_.least_load)
                            : std::vector<LayerBalance>{};
  if (why.empty() && balances.empty()) why = "there is one layer only; choose a thinner --layer";
  if (!why.empty()) {
    for (const char* name : {"weight", "slope"}) lines.push_back(skipped(name, why));
    return;
  }
  const auto add = [&](const LayerBalance& layer, CheckLine line, const std::string& remark) {
    line.y0 = layer.y0;
    line.y1 = layer.y1;
    line.remark = remark;
    lines.push_back(line);
  };
  const std::size_t count = weight_windows_.size() - 1;
  for (const auto& layer : balances)
    add(layer,
        statistical("weight", layer.carried - 1, layer.carried_error, tolerances_.weight, count,
                    balances.size()),
        fmt::format("carries {:.5f} of the weight above", layer.carried));
  for (const auto& layer : balances)
    add(layer,
        statistical("slope", layer.ratio - layer.slope, layer.ratio_error, tolerances_.slope, count,
                    balances.size()),
        fmt::format("stress ratio {:.5f}, slope less acceleration {:.5f}", layer.ratio,
                    layer.slope));
}

void PhysicsCheck::add_drifts(std::vector<CheckLine>& lines) const
{
  if (windows_.size() < least_windows) {
    for (const char* name : {"overlap_drift", "energy_defect_drift", "x_drift"})
      lines.push_back(skipped(name, few_windows));
    return;
  }
  std::vector<double> times, overlap, energy, rate;
  for (std::size_t k = 0; k + 1 < marks_.size(); ++k) {
    const auto &a = marks_[k], &b = marks_[k + 1];
    const auto mean = [](double sum, double count) { return count > 0 ? sum / count : 0; };
    times.push_back((a.time + b.time) / 2);
    overlap.push_back(mean(b.overlap - a.overlap, b.overlaps - a.overlaps) / small_diameter_);
    energy.push_back(mean(b.energy_defect - a.energy_defect, b.frames - a.frames));
    rate.push_back((b.stray - a.stray) / (b.time - a.time));
  }
  const auto drift = [&](const std::string& name, const std::vector<double>& values,
                         double allowed) {
    const auto [change, error] = change_over(times, values);
    auto line = statistical(name, change, error, allowed, times.size() - 1, 1);
    line.remark = "slope times the time it is taken over";
    lines.push_back(line);
  };
  drift("overlap_drift", overlap, tolerances_.overlap_drift);
  if (energy_.count > 0)
    drift("energy_defect_drift", energy, tolerances_.round_off);
  else
    lines.push_back(skipped("energy_defect_drift", "the file holds no /observables/energy_defect"));
  if (!(gravity_.norm() > 0)) {
    lines.push_back(skipped("x_drift", "without gravity it has no scale"));
    return;
  }
  const double speed = std::sqrt(gravity_.norm() * small_diameter_);
  const auto n = static_cast<double>(rate.size());
  const double mean = std::accumulate(rate.begin(), rate.end(), 0.0) / n;
  double squares = 0;
  for (const double r : rate) squares += (r - mean) * (r - mean);
  lines.push_back(statistical("x_drift", mean / speed, std::sqrt(squares / (n * (n - 1))) / speed,
                              tolerances_.x_drift, rate.size(), 1));
}

}  // namespace grseg
