// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/scene.hpp"

#include <string>

namespace grseg {

/// What the simulator leaves out of a scene because nothing in it calls for it, each with the
/// reason: "gravity (a shear cell has none), moving boundaries (all stand still)"; empty where the
/// scene needs everything. Leaving it out changes no byte of the run (docs/studies/effects.md).
std::string effects_left_out(const Scene& scene);

}  // namespace grseg
