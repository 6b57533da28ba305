// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/run/run.hpp"

#include <string>

/// What files of a run state about how they were made.
namespace grseg {

/// "grseg-sim 1.0.0 (1a2b3c4)".
std::string program_of_run();

/// /parameters of a trajectory that begins with the deposition of `scene`.
Parameters provenance(const Scene& scene, const RunOptions& options);

/// The same of a trajectory that begins at `time`, s, with a restart; `history` has one line for
/// each program run that led to it.
Parameters provenance_of_restart(const Scene& scene, const RunOptions& options, double time,
                                 const std::string& history);

}  // namespace grseg
