// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/frame_loop.hpp"

#include <nlohmann/json.hpp>

namespace grseg {

/// What grseg-stress, -kinetic, -micro --derived and -balance tell of a run with their defaults, by layer:
/// means of the rows of all windows, weighted by frames. A list of
///
///   {"name": "kinetic", "tool": "grseg-kinetic", "note": "...", "columns": ["y0[m]", ...],
///    "shown": ["u[m/s]", ...], "rows": [[...], ...]}
///
/// `shown` are the columns to read first. The frames are read several times. What a run does not allow
/// (one species, no forces on grains) is left out; `missing` then says why.
nlohmann::ordered_json layer_tables(FrameLoop& loop);

}  // namespace grseg
