// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/scene.hpp"
#include "sim/step/simulation.hpp"

#include <functional>

namespace grseg {

/// Functions that deposit() calls, where they are set.
struct DepositionHooks {
  /// Called after every step with the time, s, since this attempt began; what it throws ends the
  /// deposition.
  std::function<void(double)> each_step;
  /// Called with the time, s, where the grains of a bed that does not rest are slowed down.
  std::function<void(double)> slowed;
  /// Where set, the accepted deposition is run once more with the clock below 0, and this is called
  /// after every step of it, with the frame where one is due and null otherwise.
  std::function<void(const StepReport&, const Simulation&, const Frame<2>*)> record;
};

/// A bed at rest on its base at slope 0, made by letting a loose random packing fall: large grains
/// under small ones (Staron & Phillips 2015, section II), or as Scene::initial says. Its height,
/// twice the area-weighted mean height of its mobile grains above y = 0, lies within 2 % of
/// scene.depth: grains are added or left out, at constant phi_L, and the deposition is repeated
/// until it does. RunError where that cannot be reached.
///
/// A bed of depth H that still moves after 10 sqrt(2 H/g), as it may without friction, with
/// restitution 1, or under a grain that rolls on a flat wall, no longer rebounds and loses half of
/// its velocities every 2 sqrt(d_S/g) until it rests.
///
/// Rows of Grains: large grains, small grains, then boundary grains. The clock stands at 0, and
/// gravity points straight down; release() (geometry.hpp) starts the flow.
Simulation deposit(const Scene& scene, const DepositionHooks& hooks = {});

/// Number of grains that deposit() tries first, the boundary's included.
double expected_grains(const Scene& scene);

/// s that a bed falls until it rests, about; an attempt of deposit() takes as long.
double expected_time_to_rest(const Scene& scene);

/// Sets everything in `world` that follows from `scene` but its grains, walls and box; gravity
/// points straight down.
void set_conditions(World& world, const Scene& scene);

/// Twice the area-weighted mean height of the mobile grains above y = 0, m.
double bed_height(const Simulation& simulation);

}  // namespace grseg
