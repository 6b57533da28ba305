// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/parameters.hpp"
#include "sim/run/recorder.hpp"
#include "sim/scene/scene.hpp"
#include "sim/step/stiffness.hpp"

#include <string>

namespace grseg {

/// What a run has been, in numbers.
struct RunSummary {
  double simulated = 0, wall = 0;  // s
  double deposited_height = 0;     // m
  StepTotals totals;
  NumericalStiffness stiffness;
};

/// Of the sweeps and the base pressure that the run had.
NumericalStiffness stiffness_of(const Scene& scene, const StepTotals& totals);

/// As /parameters/summary_* tell it.
Parameters to_parameters(const RunSummary& summary);
/// As the user reads it.
std::string to_text(const RunSummary& summary, const Scene& scene);

}  // namespace grseg
