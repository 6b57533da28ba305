// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/parameters.hpp"
#include "sim/run/recorder.hpp"
#include "sim/run/run.hpp"
#include "sim/scene/scene.hpp"

#include <string>

/// Statements in the files of a run about how they were made, and its result in numbers.
namespace grseg {

/// Effects that the simulator leaves out because nothing in the scene needs them, each with the
/// reason: "gravity (none), moving boundaries (all stand still)"; empty where the scene needs all.
/// Results are bitwise the same with and without (docs/studies/performance.md).
std::string effects_left_out(const Scene& scene);

/// "grseg-sim 1.0.0 (1a2b3c4)".
std::string program_of_run();

/// /parameters of a trajectory that begins with the deposition of `scene`.
Parameters provenance(const Scene& scene, const RunOptions& options);

/// Provenance of a trajectory that begins at `time`, s, with a restart; `history` has one line for
/// each program run that led to it.
Parameters provenance_of_restart(const Scene& scene, const RunOptions& options, double time,
                                 const std::string& history);

/// Quantities that set the stiffness of a bed held up by an iterative solver.
struct StiffnessInput {
  double sweeps = 0;         // N per step, warm-started
  double step = 0;           // h, s
  double mass = 0;           // kg, of a small grain
  double diameter = 0;       // m, of a small grain
  double base_pressure = 0;  // N/m, weight of the bed per length of base
  double layers = 0;         // n, height of the bed in diameters
  double gravity = 0;        // m/s^2, normal to the base
};

/// Rigid discs whose contact impulses are corrected N times in a step pass news on by N grains a
/// step, and so behave as if they were elastic (Unger, Brendel, Wolf & Kertesz, Phys. Rev. E 65,
/// 061305, 2002; ordered Gauss-Seidel sweeps, where their factor q is 1).
struct NumericalStiffness {
  double stiffness = 0;    // k_eff = N m/h^2, N/m
  double rigidity = 0;     // kappa = k_eff/P: discs count as rigid from 1e4 on
  double sound_speed = 0;  // d sqrt(N)/h, m/s
  /// The longest step at these sweeps, s, and the fewest sweeps at this step for kappa >= 1e4 and
  /// for a bed that sinks by n^2 g h^2/(2N) <= 1e-3 d as a wave passes.
  double advised_step = 0, advised_sweeps = 0;
};

NumericalStiffness numerical_stiffness(const StiffnessInput& in);

/// A run in numbers.
struct RunSummary {
  double simulated = 0, end = 0, wall = 0;  // s
  double deposited_height = 0;              // m
  StepTotals totals;
  NumericalStiffness stiffness;
};

/// From the sweeps and the base pressure of the run.
NumericalStiffness stiffness_of(const Scene& scene, const StepTotals& totals);

/// As /parameters/summary_*.
Parameters to_parameters(const RunSummary& summary);

/// Adds the parameters of the summary, with unknown values, to a run that goes on.
void add_unknown_summary(Parameters& parameters);

/// For the user: what was simulated, how accurate it is, and last what is doubtful, each with its
/// remedy.
std::string to_text(const RunSummary& summary, const Scene& scene, const Grains& grains);

/// For the user: what to do with the trajectory `output`.
std::string next_steps(const std::string& output);

}  // namespace grseg
