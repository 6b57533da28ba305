// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/neighbours/grain_state.hpp"
#include "sim/step/world.hpp"

#include <cstdint>
#include <span>

/// What a step does to World::bodies, boundary grains that move. `body_of` says where in `grains`
/// each row of Grains is.
namespace grseg {

/// Gives them the velocities of the step that begins at `time`, s: those that are prescribed, and
/// of a free body those along x. Rims turn with the body.
void drive_boundaries(const World& world, double time, std::span<const std::uint32_t> body_of,
                      GrainState& grains);

/// Accelerates free bodies by their loads for `duration`, s.
void apply_loads(const World& world, double duration, std::span<const std::uint32_t> body_of,
                 GrainState& grains);

}  // namespace grseg
