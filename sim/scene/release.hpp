// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/scene.hpp"
#include "sim/step/simulation.hpp"

namespace grseg {

/// The scene at t = 0: what held the deposited grains until then is gone (the gate of a column, the
/// plug of a hopper), the plate of a shear cell lies on them and they are sheared; gravity is that
/// of the flow, and boundaries begin to move.
Simulation release(const Simulation& deposited, const Scene& scene);

/// Gives `simulation`, whose clock is set, the gravity and the moving boundaries of the flow.
void start_flow(Simulation& simulation, const Scene& scene);

}  // namespace grseg
