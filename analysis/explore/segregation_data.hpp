// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/frame_loop.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace grseg {

/// What grseg-segregation tells of a run of two species: {"numbers": [[name, value, low, high], ...],
/// "remarks": [...], "columns": ["t0[s]", ...], "rows": [[...], ...]}: those of --summary between
/// `heights`, and of each window the heights of the species' centres, the shear and how well grains are
/// mixed. Null of a run of another number of species.
nlohmann::ordered_json segregation_data(FrameLoop& loop, const std::string& heights);

}  // namespace grseg
