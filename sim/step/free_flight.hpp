// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/neighbours/grain_state.hpp"
#include "sim/step/world.hpp"

#include <cstdint>
#include <span>
#include <vector>

/// Bodies between impulses. Durations in s.
namespace grseg {

/// Moves all bodies on by `duration`.
void move_bodies(double duration, GrainState& grains, int threads);

/// Moves all bodies on by `duration`; `ahead` becomes their positions `onward` later still, m.
/// Returns a bound on the relative velocity of any two bodies, m/s.
double move_bodies(double duration, double onward, GrainState& grains, std::vector<Vec2>& ahead,
                   int threads);

/// Positions of all bodies `onward` later, m.
void forecast_positions(double onward, const GrainState& grains, std::vector<Vec2>& ahead,
                        int threads);

/// Adds `change`, m/s, to the velocities of all mobile grains.
void accelerate(const Vec2& change, GrainState& grains, int threads);

/// Brings x of all grains into [0, length), m, and counts the periods in GrainState::image.
/// RunError beyond most_periods.
void wrap_positions(double length, GrainState& grains, int threads);

// Motion of World::bodies, boundary grains that move, during a step. `body_of` gives the place in
// `grains` of each row of Grains.

/// Gives them the velocities of the step that begins at `time`, s: the prescribed ones and, for a
/// free body, those along x. Rims turn with the body.
void drive_boundaries(const World& world, double time, std::span<const std::uint32_t> body_of,
                      GrainState& grains);

/// Accelerates free bodies by their loads for `duration`, s.
void apply_loads(const World& world, double duration, std::span<const std::uint32_t> body_of,
                 GrainState& grains);

}  // namespace grseg
