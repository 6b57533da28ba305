// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/neighbours/grain_state.hpp"
#include "sim/step/world.hpp"

#include <cstdint>
#include <span>
#include <vector>

/// Motion of bodies between impulses. Durations in s.
namespace grseg {

/// Moves all bodies with their velocities for `duration`.
void move_bodies(double duration, GrainState& grains, int threads);

/// Moves all bodies for `duration`, and sets `ahead` to the positions, m, that they would have
/// after `onward` more. Returns an upper bound of the relative velocity of any two bodies, m/s.
double move_bodies(double duration, double onward, GrainState& grains, std::vector<Vec2>& ahead,
                   int threads);

/// Sets `ahead` to the positions of all bodies after `onward`, m, without moving them.
void forecast_positions(double onward, const GrainState& grains, std::vector<Vec2>& ahead,
                        int threads);

/// Adds `change`, m/s, to the velocities of all mobile grains.
void accelerate(const Vec2& change, GrainState& grains, int threads);

/// Moves x of all grains into [0, length), m, and adds the periods to GrainState::image. Throws
/// RunError beyond most_periods.
void wrap_positions(double length, GrainState& grains, int threads);

// Motion of World::bodies, boundary grains that move, during a step. `body_of`: per row of Grains,
// index in `grains`.

/// Sets the prescribed velocities of the bodies for the step that begins at `time`, s; of a free
/// body only along x. Also sets rim speeds, which follow from the rotation of the body.
void drive_boundaries(const World& world, double time, std::span<const std::uint32_t> body_of,
                      GrainState& grains);

/// Accelerates free bodies by their loads for `duration`, s.
void apply_loads(const World& world, double duration, std::span<const std::uint32_t> body_of,
                 GrainState& grains);

}  // namespace grseg
