// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/reader.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace grseg {

/// What was run, with which settings and how accurately, as far as the file says so:
///
///   name, digest, verified, notes (pairs: incomplete, undecided, waived), history, program,
///   dimension, frames, contacts, begin, end (s), scene (the text of /parameters/scene, or ""),
///   parameters (pairs of name and text), accuracy (pairs of /parameters/summary_*),
///   observables (name, unit, mean and largest over all frames)
///
/// No text is fit for a page as it is: what makes a page of it has to escape it.
nlohmann::ordered_json run_summary(const TrajectoryReader& run);

/// The lines of `grseg-check --physics` of the run in file `path`, which is read as a whole:
/// {"command", "failures", "undecided", "lines": [{"quantity", "y0", "y1", "measured", "tolerance",
/// "verdict", "remark"}, ...]}.
nlohmann::ordered_json check_run(const std::string& path);

}  // namespace grseg
