// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/run/run.hpp"
#include "sim/scene/scene.hpp"

#include <string>

/// What files of a run state about how they were made.
namespace grseg {

/// What the simulator leaves out because nothing in the scene needs it, each with the reason:
/// "gravity (none), moving boundaries (all stand still)"; empty where the scene needs everything.
/// Results are bitwise the same with and without (docs/studies/performance.md).
std::string effects_left_out(const Scene& scene);

/// "grseg-sim 1.0.0 (1a2b3c4)".
std::string program_of_run();

/// /parameters of a trajectory that begins with the deposition of `scene`.
Parameters provenance(const Scene& scene, const RunOptions& options);

/// The same of a trajectory that begins at `time`, s, with a restart; `history` has one line for
/// each program run that led to it.
Parameters provenance_of_restart(const Scene& scene, const RunOptions& options, double time,
                                 const std::string& history);

}  // namespace grseg
