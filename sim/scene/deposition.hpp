// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/scene.hpp"
#include "sim/step/simulation.hpp"

#include <functional>

namespace grseg {

/// Functions that deposit() calls if they are set.
template <int D>
struct DepositionHooks {
  /// Called after every step with the time, s, of this attempt. An exception ends the deposition.
  std::function<void(double)> each_step;
  /// Called with the time, s, whenever the grains of a bed that does not rest are slowed down.
  std::function<void(double)> slowed;
  /// If set, the accepted deposition is repeated with the clock at negative times, and this
  /// function is called after every step; the frame is null in steps without one.
  std::function<void(const StepReport&, const Simulation<D>&, const Frame<D>*)> record;
  /// Called if mixed grains have so little room that they fall in layers of one species.
  std::function<void()> layered = {};
};

/// Accepted difference of a bed's height from Scene::depth, over this depth.
inline constexpr double depth_tolerance = 0.02;

/// A bed at rest on its base at slope 0, made by letting a loose random packing fall: large grains
/// under small ones (Staron & Phillips 2015, section II), or in the arrangement Scene::initial. Its
/// height (bed_height()) differs from scene.depth by at most 2 %: the deposition is repeated with
/// more or fewer grains, at constant phi_L, until this is reached. Where attempts need very many
/// sweeps, as of heavy grains above light ones, the closest bed is taken if it differs by at most
/// 10 %. Throws RunError if no bed is close enough.
///
/// A bed of depth H may still move after 10 sqrt(2 H/g): without friction, with restitution 1, or
/// if a grain rolls on a flat wall. From then on restitution is 0, and every 2 sqrt(d_S/g) all
/// velocities are halved, but not downward ones, until the bed rests. A bed is refused, by a
/// RunError, only if it still moves 10 sqrt(2 H/g) after its highest grain could have landed.
///
/// Order of Grains: large grains, small grains, then boundary grains. The result has time 0 and
/// gravity straight down; release() (geometry.hpp) starts the flow.
template <int D>
Simulation<D> deposit(const Scene& scene, const DepositionHooks<D>& hooks = {});

/// Number of grains in the first attempt of deposit(), including boundary grains.
double expected_grains(const Scene& scene);

/// Approximate time until a falling bed rests, s: the duration of an attempt of deposit().
double expected_time_to_rest(const Scene& scene);

/// Sets all members of `world` that follow from `scene`, except grains, walls and box. Gravity
/// points straight down.
template <int D>
void set_conditions(World<D>& world, const Scene& scene);

/// Height of a flat bed above y = 0, m. The area- or volume-weighted mean height of the mobile grains
/// is halfway between it and the top of the base at y = `base_top`, m.
template <int D>
double bed_height(const Simulation<D>& simulation, double base_top = 0);

}  // namespace grseg
