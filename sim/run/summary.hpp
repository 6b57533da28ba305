// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/parameters.hpp"
#include "sim/run/recorder.hpp"
#include "sim/scene/scene.hpp"
#include "sim/step/stiffness.hpp"

#include <string>

namespace grseg {

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

/// Adds these parameters to those of a run that goes on; their values will be known at its end.
void add_unknown_summary(Parameters& parameters);

/// For the user: what was simulated, how accurate it is, and last what is doubtful, each with its
/// remedy.
std::string to_text(const RunSummary& summary, const Scene& scene, const Grains& grains);

/// For the user: what to do with the trajectory `output`.
std::string next_steps(const std::string& output);

}  // namespace grseg
