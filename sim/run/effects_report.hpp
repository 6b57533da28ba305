// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/scene.hpp"

#include <string>

namespace grseg {

/// What the simulator leaves out because nothing in the scene needs it, each with the reason:
/// "gravity (none), moving boundaries (all stand still)"; empty where the scene needs everything.
/// Results are bitwise the same with and without (docs/studies/effects.md).
std::string effects_left_out(const Scene& scene);

}  // namespace grseg
