// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/summary.hpp"

#include "formats/cli/words.hpp"
#include "formats/core/version.hpp"
#include "sim/scene/deposition.hpp"
#include "sim/scene/geometry.hpp"
#include "sim/scene/keys/keys.hpp"
#include "sim/solver/sweep.hpp"
#include "sim/step/world.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace grseg {
namespace {

// Limits for grains that count as rigid: least k/P (NumericalStiffness), largest mean overlap in
// d_S (docs/studies/first-flow.md).
constexpr double rigid = 1e4;
constexpr double small_overlap = 1e-3;

std::string grains_in_words(const Scene& scene, const Grains& grains)
{
  const auto count = [&](Species species) {
    return std::count(grains.species.begin(), grains.species.end(), species);
  };
  const auto density = scene.density_ratio == 1
                           ? fmt::format("density {:g}", scene.density)
                           : fmt::format("densities {:g} and {:g}", scene.density,
                                         scene.density * scene.density_ratio);
  return fmt::format(
      "{} small {} (d_S = {:g} mm) and {} large ones (d_L = {:g} mm), {} kg/m^{}, {} in the boundary",
      count(Species::small), scene.dimension == 3 ? "spheres" : "grains",
      1e3 * scene.small_diameter, count(Species::large), 1e3 * scene.large_diameter, density,
      scene.dimension, count(Species::boundary));
}

std::string times_in_words(const RunSummary& s)
{
  auto text = fmt::format("{:g} s simulated in {:.1f} s ({:.3g} s per second)", s.simulated, s.wall,
                          s.wall > 0 ? s.simulated / s.wall : 0);
  if (s.end > s.simulated)
    text += fmt::format(", from t = {:g} s to {:g} s", s.end - s.simulated, s.end);
  if (s.simulated_before > 0)
    text += fmt::format("; with the part before, {:g} s in {:.1f} s",
                        s.simulated_before + s.simulated, s.wall_before + s.wall);
  return text;
}

std::string flow_in_words(const RunSummary& s, const Scene& scene)
{
  auto slope =
      gravity_of<2>(scene).norm() == 0
          ? std::string("no gravity")
          : fmt::format("gravity {:g} m/s^2, slope {:g} degrees", scene.gravity, scene.slope);
  if (scene.slope_rate != 0)
    slope += fmt::format(" at t = 0, {:g} per second steeper, {:.4g} at t = {:g} s",
                         scene.slope_rate, scene.slope + scene.slope_rate * s.end, s.end);
  const auto bed =
      scene.geometry->checks_height
          ? fmt::format("deposited {:.1f} d_S high", s.deposited_height / scene.small_diameter)
          : fmt::format("filled to {:g}", scene.fill);
  return fmt::format("{}: {}; {}, friction {:g}, restitution {:g}{}", scene.geometry->name, bed,
                     slope, scene.friction, scene.restitution,
                     scene.law == ContactLaw::centred ? " (contact law centred)" : "");
}

std::string solver_in_words(const StepTotals& t, const Scene& scene)
{
  const auto met = t.missed == 0 ? "all within"
                                 : fmt::format("{:.3g} % of the steps above",
                                               100 * t.per_step(static_cast<double>(t.missed)));
  return fmt::format(
      "{}: steps of {:.4g} s, {:.1f} sweeps over {:.0f} contacts per step, {} the solver's "
      "tolerance of {:g}",
      scene.accuracy, scene.step, t.per_step(t.sweeps), t.per_step(t.force_bearing), met,
      scene.solver.tolerance);
}

std::string stiffness_in_words(const NumericalStiffness& s)
{
  const auto enough = fmt::format(
      ": enough for B and velocities; for sound and stiffness, {:.0e} by --step {:.2g} or "
      "--min-sweeps {:.0f}",
      rigid, s.advised_step, std::ceil(s.advised_sweeps));
  return fmt::format(
      "k/P = {:.1e}, k the stiffness of elastic grains that yield as much, P the base pressure{}",
      s.rigidity, s.rigidity < rigid ? enough : ": as rigid grains");
}

std::string line(const char* title, const std::string& text)
{
  return fmt::format("  {:<10} {}\n", title, text);
}

/// Forces, energy and overlaps of the steps that missed the tolerance.
std::string missed_in_words(const StepTotals& t, const Scene& scene, const Grains& grains)
{
  const double weight_d = mobile_mass(grains) * scene.gravity * scene.small_diameter;
  const double gain = std::max(t.missed_gain, 0.0);
  const auto energy =
      weight_d > 0 ? fmt::format("{:.1e} M g d_S", gain / weight_d) : fmt::format("{:.1e} J", gain);
  const auto met = static_cast<double>(t.steps - t.missed);
  const auto force =
      t.largest_impulses > 0
          ? fmt::format("the largest force was {:.2g} times its mean over other steps, ",
                        t.missed_impulse * met / t.largest_impulses)
          : "";
  return fmt::format(
      "{}contacts added at most {} of energy, overlaps just after were up to {:.1e} d_S", force,
      energy, t.missed_overlap / scene.small_diameter);
}

/// Remark if the bed is not as high as the scene says, because attempts at it were slow (deposit()).
std::string height_in_words(double height, const Scene& scene)
{
  const double off = height / scene.depth - 1;
  if (!scene.geometry->checks_height || std::abs(off) <= depth_tolerance) return {};
  return line("remark",
              fmt::format("the bed is {:.2g} % {} than the depth asked for: an attempt at another "
                          "one takes long, since its grains differ greatly",
                          100 * std::abs(off), off > 0 ? "higher" : "lower"));
}

/// How the bed moves, and a remark if it does not; "" in other geometries.
std::string motion_in_words(const EndOfFlow& end)
{
  if (std::isnan(end.inertial_number)) return {};
  auto text = line(
      "motion", fmt::format("{:.2g} m/s on average, {:.2g} m/s at the surface; inertial number "
                            "{:.2g}, stress ratio {:.3f} in the last second, solid fraction {:.2f}",
                            end.mean_velocity, end.surface_velocity, end.inertial_number,
                            end.stress_ratio, end.solid_fraction));
  if (end.is_jammed())
    text +=
        line("remark",
             "the bed is at rest or creeps (inertial number below 1e-3): B would be of a jammed "
             "bed, not of a flow; choose a steeper --slope or a longer --duration");
  else if (end.accelerates())
    text +=
        line("remark",
             fmt::format("the flow accelerates: a stress ratio of {:.3f} would balance gravity; "
                         "choose a longer --duration or, if it is too steep, another --slope",
                         end.slope));
  return text;
}

/// Reasons to doubt the run and remarks, one per line, with remedies.
std::string doubts(const StepTotals& t, const Scene& scene, const Grains& grains)
{
  std::string lines;
  if (t.missed > 0)
    lines += line("doubt", fmt::format("{} missed the tolerance of the solver. There, {}: raise "
                                       "--max-sweeps, now {}, or choose a smaller --step",
                                       counted(static_cast<std::size_t>(t.missed), "step"),
                                       missed_in_words(t, scene, grains), scene.solver.max_sweeps));
  if (t.solved_again > 0)
    lines +=
        line("remark", fmt::format("{} {} solved again, because rebounds with friction would have "
                                   "created energy",
                                   counted(static_cast<std::size_t>(t.solved_again), "step"),
                                   t.solved_again == 1 ? "was" : "were"));
  if (t.divided > 0)
    lines += line("remark",
                  fmt::format("{} {} divided into parts, because grains might have "
                              "approached each other by more than half a diameter in a whole step",
                              counted(static_cast<std::size_t>(t.divided), "step"),
                              t.divided == 1 ? "was" : "were"));
  if (t.mean_overlap() > small_overlap * scene.small_diameter)
    lines += line(
        "doubt", fmt::format("the mean overlap is above {:g} d_S: contacts per grain and gaps are "
                             "wrong, velocities are off by some per cent, B and the order of rules "
                             "hardly change; choose a smaller --step or a larger --min-sweeps",
                             small_overlap));
  if (t.passed_into(scene.small_diameter))
    lines += line(
        "doubt",
        fmt::format("a grain overlapped another one or a wall by more than {:g} d_S, "
                    "and forces there are wrong: choose a smaller --step or a larger --min-sweeps",
                    deep_overlap));
  return lines;
}

}  // namespace

std::string effects_left_out(const Scene& scene)
{
  std::vector<std::string> all;
  const auto add = [&](bool left_out, const char* what) {
    if (left_out) all.emplace_back(what);
  };
  // A contact that rebounds one step later needs its stored approach velocity.
  const bool remembers = law_parameters(scene).horizon > 0;
  add(scene.friction == 0, "friction (its coefficient is 0)");
  add(!scene.rotation, "rotation (off)");
  add(scene.restitution == 0 && !remembers, "restitution (its coefficient is 0)");
  add(!remembers, "memory of approaches (contacts act at once)");
  add(gravity_of<2>(scene).norm() == 0, "gravity (none)");
  add(scene.dimension == 2 && scene.lateral == Scene::Lateral::walls,
      "periodicity (the cell has ends)");
  add(!moves_boundaries(scene), "moving boundaries (none moves)");
  return fmt::format("{}", fmt::join(all, ", "));
}

std::string program_of_run()
{
  return "grseg-sim " + version_with_hash();
}

Parameters provenance(const Scene& scene, const RunOptions& options)
{
  auto parameters = to_parameters(scene);
  parameters.texts["program"] = program_of_run();
  parameters.texts["instruction_set"] = instruction_set();
  parameters.texts["command_line"] = options.command_line;
  parameters.texts["history"] = options.command_line;
  parameters.texts["effects_left_out"] = effects_left_out(scene);
  return parameters;
}

Parameters provenance_of_restart(const Scene& scene, const RunOptions& options, double time,
                                 const std::string& history)
{
  auto parameters = provenance(scene, options);
  parameters.texts["history"] = history;
  parameters.numbers["restart_time"] = {time};
  if (options.perturbation.size > 0) {
    parameters.numbers["perturb"] = {options.perturbation.size};
    parameters.numbers["seed_perturbation"] = {static_cast<double>(options.perturbation.seed)};
  }
  return parameters;
}

NumericalStiffness stiffness_of(const Scene& scene, const StepTotals& totals)
{
  const double d = scene.small_diameter;
  const auto base_pressure = scene.geometry->base_pressure;
  const double on_base = totals.per_step(totals.base_impulse.y()) / (scene.step * base_area(scene));
  // A row of spheres bears the pressure on a strip that is as wide as they are.
  const double strip = scene.dimension == 3 ? d : 1;
  return numerical_stiffness(
      {.sweeps = totals.per_step(totals.sweeps),
       .step = scene.step,
       .mass = scene.density * nominal_volume(scene, d),
       .diameter = d,
       .base_pressure = strip * (base_pressure ? base_pressure(scene) : on_base),
       .layers = scene.depth / d,
       .gravity = scene.gravity * std::cos(scene.slope * std::numbers::pi / 180)});
}

Parameters to_parameters(const RunSummary& s)
{
  const auto& t = s.totals;
  Parameters p;
  auto& n = p.numbers;
  n["summary_sweeps_per_step"] = {t.per_step(t.sweeps)};
  n["summary_contacts_per_step"] = {t.per_step(t.force_bearing)};
  n["summary_divided_steps"] = {static_cast<double>(t.divided)};
  n["summary_solved_again"] = {static_cast<double>(t.solved_again)};
  n["summary_missed_share"] = {t.per_step(static_cast<double>(t.missed))};
  n["summary_missed_gain"] = {t.missed_gain};
  n["summary_missed_overlap"] = {t.missed_overlap};
  n["summary_largest_residual"] = {t.largest_residual};
  n["summary_mean_overlap"] = {t.mean_overlap()};
  n["summary_largest_overlap"] = {t.largest_overlap};
  n["summary_mean_gap"] = {t.mean_gap_bearing()};
  n["summary_deposited_height"] = {s.deposited_height};
  n["summary_mean_velocity"] = {s.end_of_flow.mean_velocity};
  n["summary_surface_velocity"] = {s.end_of_flow.surface_velocity};
  n["summary_inertial_number"] = {s.end_of_flow.inertial_number};
  n["summary_stress_ratio"] = {s.end_of_flow.stress_ratio};
  n["summary_solid_fraction"] = {s.end_of_flow.solid_fraction};
  n["summary_stiffness"] = {s.stiffness.stiffness};
  n["summary_rigidity"] = {s.stiffness.rigidity};
  n["summary_sound_speed"] = {s.stiffness.sound_speed};
  n["summary_advised_step"] = {s.stiffness.advised_step};
  n["summary_advised_sweeps"] = {s.stiffness.advised_sweeps};
  return p;
}

void add_unknown_summary(Parameters& parameters)
{
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [name, value] : to_parameters(RunSummary{}).numbers)
    parameters.numbers[name] = {unknown};
}

std::string to_text(const RunSummary& s, const Scene& scene, const Grains& grains)
{
  auto text = "grseg-sim: " + times_in_words(s) + '\n';
  text += line("grains", grains_in_words(scene, grains));
  text += line("flow", flow_in_words(s, scene));
  text += motion_in_words(s.end_of_flow);
  text += line("accuracy", solver_in_words(s.totals, scene));
  text += line("overlap",
               fmt::format("{:.1e} d_S on average over pairs that overlap, {:.1e} d_S at most",
                           s.totals.mean_overlap() / scene.small_diameter,
                           s.totals.largest_overlap / scene.small_diameter));
  text += line("stiffness", stiffness_in_words(s.stiffness));
  const auto left_out = effects_left_out(scene);
  if (!left_out.empty())
    text += line("speed", "computed without what this scene does not need: " + left_out);
  return text + height_in_words(s.deposited_height, scene) + doubts(s.totals, scene, grains);
}

std::string next_steps(const std::string& output, const Scene& scene)
{
  const auto run = shell_word(output);
  const bool is_drum = scene.geometry == &drum_geometry;
  return line("next", fmt::format("grseg-stress {}{} -o stress.tsv, then grseg-fit stress.tsv{}",
                                  run, is_drum ? " --bins xy --layer 2dS" : "",
                                  is_drum ? " --component pressure" : "")) +
         line("look", fmt::format("grseg-explore {} -o explore.html", run));
}

NumericalStiffness numerical_stiffness(const StiffnessInput& in)
{
  constexpr double sinking = 1e-3;
  // Both conditions are lower limits of N/h^2.
  const double for_rigidity = rigid * in.base_pressure / in.mass;
  const double for_sinking = in.layers * in.layers * in.gravity / (2 * sinking * in.diameter);
  const double least = std::max(for_rigidity, for_sinking);
  NumericalStiffness out;
  out.stiffness = in.sweeps * in.mass / (in.step * in.step);
  out.rigidity = out.stiffness / in.base_pressure;
  out.sound_speed = in.diameter * std::sqrt(in.sweeps) / in.step;
  out.advised_step = std::sqrt(in.sweeps / least);
  out.advised_sweeps = least * in.step * in.step;
  return out;
}

}  // namespace grseg
