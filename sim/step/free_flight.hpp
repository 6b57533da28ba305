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
template <int D>
void move_bodies(double duration, GrainState<D>& grains, int threads);

/// Moves all bodies for `duration`, and sets `ahead` to the positions, m, that they would have
/// after `onward` more. Returns an upper bound of the relative velocity of any two bodies, m/s.
template <int D>
double move_bodies(double duration, double onward, GrainState<D>& grains,
                   std::vector<Position<D>>& ahead, int threads);

/// Sets `ahead` to the positions of all bodies after `onward`, m, without moving them.
template <int D>
void forecast_positions(double onward, const GrainState<D>& grains, std::vector<Position<D>>& ahead,
                        int threads);

/// Adds `change`, m/s, to the velocities of all mobile grains.
template <int D>
void accelerate(const Vector<D>& change, GrainState<D>& grains, int threads);

/// Moves all grains into the periodic cell along its periodic axes, and adds the periods to
/// GrainState::image. Throws RunError beyond most_periods.
template <int D>
void wrap_positions(const Box& box, GrainState<D>& grains, int threads);

// Motion of World::bodies, boundary grains that move, during a step. `body_of`: per row of Grains,
// index in `grains`.

/// Sets the prescribed velocities of the bodies at the beginning of the step, at `time`, s; of a
/// free body only along x. Also sets rim speeds, which follow from the rotation of the body.
template <int D>
void drive_boundaries(const World<D>& world, double time, std::span<const std::uint32_t> body_of,
                      GrainState<D>& grains);

/// In the middle of that step, sets the velocities of the bodies at its end; free bodies are
/// accelerated by their loads.
template <int D>
void accelerate_boundaries(const World<D>& world, double time,
                           std::span<const std::uint32_t> body_of, GrainState<D>& grains);

}  // namespace grseg
