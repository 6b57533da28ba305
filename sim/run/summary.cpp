// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/summary.hpp"

#include "sim/run/effects_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace grseg {

NumericalStiffness stiffness_of(const Scene& scene, const StepTotals& totals)
{
  const double d = scene.small_diameter;
  StiffnessInput in;
  in.sweeps = totals.per_step(totals.sweeps);
  in.step = scene.step;
  in.mass = scene.density * std::numbers::pi / 4 * d * d;
  in.diameter = d;
  in.base_pressure = scene.geometry == Scene::Geometry::shear
                         ? scene.plate_pressure
                         : totals.per_step(totals.base_impulse.y()) / (scene.step * scene.length);
  in.layers = scene.depth / d;
  in.gravity = scene.gravity * std::cos(scene.slope * std::numbers::pi / 180);
  return numerical_stiffness(in);
}

Parameters to_parameters(const RunSummary& s)
{
  const auto& t = s.totals;
  Parameters p;
  auto& n = p.numbers;
  n["summary_sweeps_per_step"] = {t.per_step(t.sweeps)};
  n["summary_contacts_per_step"] = {t.per_step(t.force_bearing)};
  n["summary_missed_share"] = {t.per_step(static_cast<double>(t.missed))};
  n["summary_largest_residual"] = {t.largest_residual};
  n["summary_mean_overlap"] = {t.mean_overlap()};
  n["summary_largest_overlap"] = {t.largest_overlap};
  n["summary_mean_gap"] = {t.mean_gap_bearing()};
  n["summary_deposited_height"] = {s.deposited_height};
  n["summary_stiffness"] = {s.stiffness.stiffness};
  n["summary_rigidity"] = {s.stiffness.rigidity};
  n["summary_sound_speed"] = {s.stiffness.sound_speed};
  n["summary_advised_step"] = {s.stiffness.advised_step};
  n["summary_advised_sweeps"] = {s.stiffness.advised_sweeps};
  return p;
}

std::string to_text(const RunSummary& s, const Scene& scene)
{
  const auto& t = s.totals;
  const double d = scene.small_diameter;
  const auto cost = fmt::format("grseg-sim: {:g} s simulated in {:.1f} s: {:.3g} s per second\n",
                                s.simulated, s.wall, s.wall > 0 ? s.simulated / s.wall : 0);
  const auto solver = fmt::format(
      "  accuracy {}: step {:.4g} s, tolerance {:g}; {:.1f} sweeps and {:.0f} contacts per step; "
      "tolerance missed in {:.3g} % of steps\n",
      scene.accuracy, scene.step, scene.solver.tolerance, t.per_step(t.sweeps),
      t.per_step(t.force_bearing), 100 * t.per_step(static_cast<double>(t.missed)));
  const auto geometry = fmt::format(
      "  mean overlap {:.2e} d_S, largest {:.2e} d_S, mean |gap| under force {:.2e} d_S; deposited "
      "height {:.2f} d_S\n",
      t.mean_overlap() / d, t.largest_overlap / d, t.mean_gap_bearing() / d,
      s.deposited_height / d);
  const auto stiffness = fmt::format(
      "  as stiff as k = {:.3g} N/m, k/P = {:.3g} at the base, sound {:.3g} m/s; for k/P = 1e4 and "
      "waves below 1e-3 d: step {:.2g} s or {:.0f} sweeps\n",
      s.stiffness.stiffness, s.stiffness.rigidity, s.stiffness.sound_speed,
      s.stiffness.advised_step, s.stiffness.advised_sweeps);
  const auto none = effects_left_out(scene);
  const auto effects = fmt::format("  left out: {}\n", none.empty() ? "nothing" : none);
  return cost + solver + geometry + stiffness + effects;
}

}  // namespace grseg
