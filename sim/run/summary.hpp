// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/parameters.hpp"
#include "sim/run/end_of_flow.hpp"
#include "sim/run/recorder.hpp"
#include "sim/run/run.hpp"
#include "sim/scene/scene.hpp"

#include <string>

/// Provenance of a run, and summary of its accuracy, for its files and for the user.
namespace grseg {

/// Effects that the simulator leaves out because nothing in the scene needs them, each with the
/// reason: "gravity (none), moving boundaries (none moves)"; empty if the scene needs all.
/// Results are bitwise the same with and without (docs/studies/performance.md).
std::string effects_left_out(const Scene& scene);

/// Name and version of this program, such as "grseg-sim 1.0.0 (1a2b3c4)".
std::string program_of_run();

/// Entries of /parameters of a trajectory that begins with the deposition of `scene`.
Parameters provenance(const Scene& scene, const RunOptions& options);

/// Entries of /parameters of a trajectory that begins with a restart at `time`, s. `history`: the
/// command lines that led to it, one per line.
Parameters provenance_of_restart(const Scene& scene, const RunOptions& options, double time,
                                 const std::string& history);

/// Quantities that determine the stiffness of a bed whose contact forces an iterative solver finds.
struct StiffnessInput {
  double sweeps = 0;         // N, mean number of sweeps per step, warm-started
  double step = 0;           // h, duration of a step, s
  double mass = 0;           // kg, mass of a small grain
  double diameter = 0;       // m, diameter of a small grain
  double base_pressure = 0;  // P, N/m: pressure on the base (spheres: times their diameter)
  double layers = 0;         // n, height of the bed in diameters
  double gravity = 0;        // m/s^2, component normal to the base
};

/// Effective stiffness of a bed of rigid grains. If contact impulses are corrected N times in a
/// step, information spreads by N grains per step, and the grains behave as if they were elastic
/// (Unger, Brendel, Wolf & Kertesz, Phys. Rev. E 65, 061305, 2002; ordered Gauss-Seidel sweeps,
/// with their factor q = 1).
struct NumericalStiffness {
  double stiffness = 0;    // k_eff = N m/h^2, N/m
  double rigidity = 0;     // kappa = k_eff/P: grains count as rigid from 1e4 on
  double sound_speed = 0;  // d sqrt(N)/h, m/s, speed of sound in the bed
  /// Longest step at this number of sweeps, s, and least number of sweeps at this step, so that
  /// kappa >= 1e4 and the bed sinks by n^2 g h^2/(2N) <= 1e-3 d while a wave passes through it.
  double advised_step = 0, advised_sweeps = 0;
};

NumericalStiffness numerical_stiffness(const StiffnessInput& in);

/// Results of a run that are stored and printed at its end.
struct RunSummary {
  double simulated = 0, end = 0, wall = 0;  // s: duration of the flow, its end, wall-clock time
  // s: the same, of the part of the run that was there before and is continued
  double simulated_before = 0, wall_before = 0;
  double deposited_height = 0;  // m, height of the deposited bed
  StepTotals totals;
  NumericalStiffness stiffness;
  EndOfFlow end_of_flow;
};

/// Effective stiffness from the sweeps and the base pressure of a run.
NumericalStiffness stiffness_of(const Scene& scene, const StepTotals& totals);

/// Entries summary_* of /parameters.
Parameters to_parameters(const RunSummary& summary);

/// Adds the entries summary_* with the value NaN, for a run that is not finished.
void add_unknown_summary(Parameters& parameters);

/// Text for the user: the flow, its accuracy, and reasons for doubt with their remedies.
std::string to_text(const RunSummary& summary, const Scene& scene, const Grains& grains);

/// Text for the user: commands that analyse the trajectory `output`: by layers, of a drum by cells.
std::string next_steps(const std::string& output, const Scene& scene);

}  // namespace grseg
