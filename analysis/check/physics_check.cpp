// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/physics_check.hpp"

#include "analysis/check/file_check.hpp"
#include "formats/cli/frame_range.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/length.hpp"

#include <fmt/format.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace grseg {

Drift change_over(const std::vector<double>& times, const std::vector<double>& values)
{
  double constant = 0, slope = 0, c00 = 0, c01 = 0, c11 = 0, squares = 0;
  gsl_fit_linear(times.data(), 1, values.data(), 1, times.size(), &constant, &slope, &c00, &c01,
                 &c11, &squares);
  const double span = times.back() - times.front();
  return {slope * span, std::sqrt(std::max(0.0, c11)) * span};
}

Drift mean_of(const std::vector<double>& values)
{
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (n * (n - 1)))};
}

WindowMeans::WindowMeans(const std::vector<RunningSums>& windows)
{
  const auto mean = [](double sum, double count) { return count > 0 ? sum / count : 0; };
  for (std::size_t k = 0; k + 1 < windows.size(); ++k) {
    const auto &a = windows[k], &b = windows[k + 1];
    time.push_back((a.time + b.time) / 2);
    overlap.push_back(mean(b.overlap - a.overlap, b.overlaps - a.overlaps));
    energy_defect.push_back(mean(b.energy_defect - a.energy_defect, b.frames - a.frames));
    stray_rate.push_back((b.stray - a.stray) / (b.time - a.time));
    stray_rate_across.push_back((b.stray_across - a.stray_across) / (b.time - a.time));
  }
}

namespace {

using checks::named;

// Number of windows that a statistical check needs: three for the error, and the last one, which
// only marks the end of the window before.
constexpr std::size_t least_windows = 4;
constexpr const char* few_windows = "fewer than four windows";
constexpr const char* no_energy_defect = "the file holds no /observables/energy_defect";

Layers layers_of(const TrajectoryReader& run, const std::string& layer)
{
  const auto& box = run.box();
  return {parse_length(layer, "--layer", {run.small_diameter(), run.large_diameter()}),
          box.length_x, run.dimension() == 3 ? std::optional(box.length_z) : std::nullopt};
}

/// First time step to check: --begin, else t = 0 (the tilt), else the first frame if the run ends
/// before t = 0. Windows are cut by steps, too.
std::int64_t first_step(const TrajectoryReader& run, const WindowSettings& settings)
{
  if (settings.begin) return whole_steps(*settings.begin, run.step(), "--begin");
  const bool ends_before = run.size() > 0 && run.steps().back() < 0;
  return ends_before ? run.steps().front() : 0;
}

std::int64_t end_step(const TrajectoryReader& run, const WindowSettings& settings)
{
  return settings.end ? whole_steps(*settings.end, run.step(), "--end")
                      : std::numeric_limits<std::int64_t>::max();
}

std::vector<double> observable_of(const TrajectoryReader& run, const std::string& name)
{
  return run.has_observable(name) ? run.observable(name) : std::vector<double>{};
}

/// Force of base and walls (N) by frame; empty if the file does not have all components.
template <int D>
std::vector<Vector<D>> base_force_of(const TrajectoryReader& run)
{
  std::vector<Vector<D>> force(run.size());
  for (int axis = 0; axis < D; ++axis) {
    const auto component = observable_of(run, fmt::format("base_force_{}", "xyz"[axis]));
    force.resize(std::min(force.size(), component.size()));
    for (std::size_t k = 0; k < force.size(); ++k) force[k][axis] = component[k];
  }
  return force;
}

}  // namespace

template <int D>
PhysicsCheck<D>::PhysicsCheck(const TrajectoryReader& run, const PhysicsSettings& settings)
    : run_(run),
      tolerances_(settings.tolerances),
      judge_(settings.tolerances, run.stores_float32()),
      gravity_(run.gravity<D>()),
      small_diameter_(run.small_diameter()),
      rules_(read_contact_rules(run)),
      rotation_(run.parameters().find_number("rotation").value_or(1) != 0),
      frames_are_steps_(run.parameters().text("import_format").empty()),
      layers_(layers_of(run, settings.layer)),
      begin_(first_step(run, settings.windows)),
      end_(end_step(run, settings.windows)),
      forces_(gravity_, run.step()),
      motion_(gravity_, run.step()),
      partials_(run.box(), run.species().size()),
      contacts_(rules_),
      base_force_(base_force_of<D>(run)),
      energy_defect_(observable_of(run, "energy_defect"))
{
  tolerances_.require_valid();
  try {
    windows_ = cut_into_windows(times_of(run), settings.windows).list;
  } catch (const RunError&) {
    // A run that is too short for a window still gets all checks that need none.
  }
}

template <int D>
bool PhysicsCheck<D>::in_window(std::size_t index) const
{
  return window_ < windows_.size() && index >= windows_[window_].frames.front();
}

/// True if no side wall carries a part of the weight.
template <int D>
bool PhysicsCheck<D>::is_periodic() const
{
  return run_.box().periodic_x && (D == 2 || run_.box().periodic_z);
}

template <int D>
void PhysicsCheck<D>::add(std::size_t index, const Frame<D>& frame)
{
  if (frame.step < begin_ || frame.step >= end_) return;
  const auto& grains = run_.grains();
  std::optional<Vector<D>> base;
  if (!base_force_.empty()) base = base_force_[index];
  const double step = step_of_force(frame, run_.step());
  const auto total = total_motion(grains, frame, run_.box(), frames_are_steps_ ? step : 0);
  motion_.add(total, base);
  if (in_window(index) && windows_[window_].frames.front() == index) begin_window(frame);
  has_force_ = has_force_ && !frame.force.empty();
  forces_.add(grains, frame);
  partials_.add(grains, frame);
  contacts_.use_step(step);
  contacts_.add(grains, frame);
  // At such small energies the energy defect is only round-off of the forces.
  const bool at_rest = total.energy < 1e-12 * total.mass * gravity_.norm() * small_diameter_;
  if (!energy_defect_.empty()) energy_.add(at_rest ? 0 : energy_defect_[index], frame.time, 0);
  if (!in_window(index)) return;
  if (weights_) weights_->add_to_mean(grains, frame);
  if (windows_[window_].frames.back() == index) end_window();
}

template <int D>
void PhysicsCheck<D>::begin_window(const Frame<D>& frame)
{
  const auto& overlap = contacts_.overlap;
  window_starts_.push_back({frame.time, motion_.stray(0), D == 3 ? motion_.stray(D - 1) : 0,
                            overlap.sum, overlap.count, energy_.sum, energy_.count});
  if (gravity_.start.y() < 0 && !gravity_.turns() && is_periodic())
    weights_.emplace(layers_, gravity_.start, small_diameter_ / 2, run_.species().size());
}

/// Reads the frames of the window again: the kinetic stress needs the mean velocity, which is known
/// only at the end of the window.
template <int D>
void PhysicsCheck<D>::end_window()
{
  if (weights_) {
    Frame<D> frame;
    for (const std::size_t k : windows_[window_].frames) {
      run_.read(k, frame, {.velocity = true, .contacts = true});
      weights_->add(run_.grains(), frame);
    }
    weight_windows_.push_back(weights_->window());
    weights_.reset();
  }
  ++window_;
}

template <int D>
std::vector<CheckLine> PhysicsCheck<D>::lines() const
{
  std::vector<CheckLine> lines;
  if (motion_.frames() == 0) return {skipped("physics", "no frame between --begin and --end")};
  add_balances(lines);
  add_contacts(lines);
  add_layers(lines);
  add_drifts(lines);
  return lines;
}

template <int D>
void PhysicsCheck<D>::add_balances(std::vector<CheckLine>& lines) const
{
  const auto add = [&](const Check& check, const WorstCase& worst, const char* what,
                       const char* why_skipped) {
    lines.push_back(why_skipped != nullptr ? skipped(check.name, why_skipped)
                                           : judge_.largest(check, worst, what));
  };
  const auto& momentum = motion_.momentum();
  add(named("force_balance"), forces_.forces, "grain",
      has_force_ ? nullptr : "the file holds no `force` of grains");
  hold_to_import(lines.back());
  add(named("torque_balance"), forces_.torques, "grain",
      !rotation_                   ? "grains do not rotate"
      : forces_.torques.count == 0 ? "no two frames are consecutive steps"
                                   : nullptr);
  add(named("total_momentum"), momentum, "",
      momentum.count > 0    ? nullptr
      : base_force_.empty() ? D == 2 ? "the file holds no /observables/base_force_x, _y"
                                     : "the file holds no /observables/base_force_x, _y, _z"
                            : "there is one frame only");
  add(named("sum_of_partials"), partials_.defect, "", nullptr);
  add(named("energy_defect"), energy_, "", energy_.count > 0 ? nullptr : no_energy_defect);
}

/// Judges the balance of forces of an import by what the import accepted, its tolerance or a larger
/// residual that it explained: programs that write damped forces late, or with few digits, miss
/// round-off by far.
template <int D>
void PhysicsCheck<D>::hold_to_import(CheckLine& line) const
{
  const auto number = [&](const char* name) {
    return run_.parameters().find_number(name).value_or(0);
  };
  const double accepted =
      std::max(number("import_tolerance"), number("import_residual_largest") * (1 + 1e-6));
  if (line.verdict != Verdict::failed || accepted <= line.tolerance) return;
  line =
      judged(line.quantity, line.measured, accepted, line.remark + "; the import accepted as much");
}

template <int D>
void PhysicsCheck<D>::add_contacts(std::vector<CheckLine>& lines) const
{
  const auto add = [&](const Check& largest, const Check& mean, const WorstCase& worst, double unit,
                       const char* why_skipped = nullptr) {
    if (why_skipped != nullptr) return skip({largest, mean}, why_skipped, lines);
    lines.push_back(judge_.largest(largest, worst, "contact", unit));
    lines.push_back(judge_.mean(mean, worst, unit));
  };
  const char* no_velocities =
      has_force_ ? nullptr
                 : "the file holds no `force` of grains, so velocities before the step are unknown";
  const char* no_restitution =
      rules_.restitution ? nullptr : "the file holds no /parameters/restitution";
  add(named("coulomb_largest"), named("coulomb_mean"), contacts_.coulomb, 1,
      rules_.friction ? nullptr : "the file holds no /parameters/friction");
  double pull = 0;  // of a frame's normal force, in an import
  for (const double of_frame : observable_of(run_, "check_pull")) pull = std::fmax(pull, of_frame);
  const auto damped = fmt::format(
      "damped contacts may pull: grseg-import accepted {:.2g} of the normal force of a frame",
      pull);
  add(named("tension_largest"), named("tension_mean"), contacts_.tension, 1,
      pull > 0 ? damped.c_str() : nullptr);
  add(named("open_gap_largest"), named("open_gap_mean"), contacts_.open_gap, small_diameter_,
      no_velocities);
  add(named("approach_largest"), named("approach_mean"), contacts_.approach, small_diameter_,
      has_force_ ? no_restitution : no_velocities);
  add(named("overlap_largest"), named("overlap_mean"), contacts_.overlap, small_diameter_);
  if (rules_.accuracy != "draft") return;
  for (auto& line : lines)
    if (line.verdict == Verdict::failed &&
        (line.quantity.starts_with("approach") || line.quantity.starts_with("overlap")))
      line.remark += "; the tolerance is for --accuracy standard, and this run is a draft";
}

/// Reason why layers cannot be compared with the weight above them; "" if they can.
template <int D>
std::string PhysicsCheck<D>::why_no_layers() const
{
  if (gravity_.turns()) return "the slope turns, so no window has one";
  if (!(gravity_.start.y() < 0)) return "gravity does not press on the base";
  if (!is_periodic()) return "the cell is not periodic, so that walls carry a part";
  if (!motion_.same_grains())
    return "grains come and go, which changes the weight and the momentum";
  return windows_.size() < least_windows ? few_windows : "";
}

template <int D>
void PhysicsCheck<D>::add_layers(std::vector<CheckLine>& lines) const
{
  std::string why_skipped = why_no_layers();
  std::vector<LayerBalance> layers;
  if (why_skipped.empty()) {
    layers = balance_layers(weight_windows_, layers_, tolerances_.least_load);
    if (layers.empty()) why_skipped = "there is one layer only; choose a thinner --layer";
  }
  if (!why_skipped.empty())
    return skip({named("weight"), named("slope"), named("slope_across")}, why_skipped, lines);
  const auto add = [&](const Check& check, const LayerBalance& layer, double deviation,
                       double error, const std::string& remark) {
    auto line =
        judge_.statistical(check, deviation, error, weight_windows_.size() - 1, layers.size());
    line.y0 = layer.y0;
    line.y1 = layer.y1;
    line.remark = remark;
    lines.push_back(line);
  };
  for (const auto& layer : layers)
    add(named("weight"), layer, layer.carried - 1, layer.carried_error,
        fmt::format("carries {:.5f} of the weight above", layer.carried));
  for (const auto& [check, ratio] : {std::pair{named("slope"), &LayerBalance::along},
                                     {named("slope_across"), &LayerBalance::across}})
    for (const auto& layer : layers)
      if (const auto& found = layer.*ratio; applies(check))
        add(check, layer, found.ratio - found.slope, found.error,
            fmt::format("stress ratio {:.5f}, slope less acceleration {:.5f}", found.ratio,
                        found.slope));
}

template <int D>
void PhysicsCheck<D>::add_drifts(std::vector<CheckLine>& lines) const
{
  if (windows_.size() < least_windows)
    return skip(
        {named("overlap_drift"), named("energy_defect_drift"), named("x_drift"), named("z_drift")},
        few_windows, lines);
  const WindowMeans means(window_starts_);
  const auto add_change = [&](const Check& check, std::vector<double> values, double unit) {
    for (double& value : values) value /= unit;
    const auto [change, error] = change_over(means.time, values);
    auto line = judge_.statistical(check, change, error, means.time.size() - 1, 1);
    line.remark = "slope of the trend times its duration";
    lines.push_back(line);
  };
  add_change(named("overlap_drift"), means.overlap, small_diameter_);
  if (energy_.count > 0)
    add_change(named("energy_defect_drift"), means.energy_defect, 1);
  else
    lines.push_back(skipped(named("energy_defect_drift").name, no_energy_defect));
  if (!(gravity_.norm() > 0))
    return skip({named("x_drift"), named("z_drift")}, "without gravity a drift has no scale",
                lines);
  if (!run_.has_images())
    return skip({named("x_drift"), named("z_drift")},
                "the file does not tell how often grains have crossed a period", lines);
  const double speed = std::sqrt(gravity_.norm() * small_diameter_);
  for (const auto& [check, rates] : {std::pair{named("x_drift"), &means.stray_rate},
                                     {named("z_drift"), &means.stray_rate_across}}) {
    const auto [rate, error] = mean_of(*rates);
    if (applies(check))
      lines.push_back(judge_.statistical(check, rate / speed, error / speed, rates->size(), 1));
  }
}

template <int D>
void PhysicsCheck<D>::skip(std::initializer_list<Check> checks, const std::string& why,
                           std::vector<CheckLine>& lines)
{
  for (const auto& check : checks)
    if (applies(check)) lines.push_back(skipped(check.name, why));
}

template class PhysicsCheck<2>;
template class PhysicsCheck<3>;

template <int D>
std::vector<CheckLine> check_run(const TrajectoryReader& run, const ChecksAsked& asked,
                                 const std::function<void(std::size_t)>& shown)
{
  ContentCheck content(run);
  std::optional<SpecificationCheck> specification;
  if (asked.deep) specification.emplace(run);
  std::optional<PhysicsCheck<D>> physics;
  if (asked.physics) physics.emplace(run, *asked.physics);
  Frame<D> frame;
  for (std::size_t k = 0; k < run.size(); ++k) {
    run.read(k, frame, {.velocity = true, .contacts = true, .force = true});
    content.add(k, frame);
    if (specification) specification->add(k, frame);
    if (physics) physics->add(k, frame);
    if (shown) shown(k + 1);
  }
  auto lines = content.lines();
  const auto append = [&](const std::vector<CheckLine>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
  };
  if (specification) append(specification->lines());
  if (physics) append(physics->lines());
  return lines;
}
template std::vector<CheckLine> check_run<2>(const TrajectoryReader&, const ChecksAsked&,
                                             const std::function<void(std::size_t)>&);
template std::vector<CheckLine> check_run<3>(const TrajectoryReader&, const ChecksAsked&,
                                             const std::function<void(std::size_t)>&);

}  // namespace grseg
