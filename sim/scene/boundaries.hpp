// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/scene.hpp"
#include "sim/step/simulation.hpp"

#include <vector>

namespace grseg {

/// What bounds the grains of a scene while they are deposited. y = 0 is where Scene::origin says;
/// in a drum, at its lowest point.
struct Boundaries {
  std::vector<Vec2> position;  // m, of boundary grains
  std::vector<double> radius;  // m
  std::vector<Wall> walls;
  double top = 0;  // m, of the base under the falling grains
};
Boundaries boundaries_of(const Scene& scene);

/// Where grains may be at height y before they fall: from `left` to `right`, m.
struct Room {
  double left = 0, right = 0;
};
Room room_at(const Scene& scene, double y);

/// How the boundary grains of a scene move; they are the last rows of `grains`, in one piece.
std::vector<BoundaryBody> bodies_of(const Scene& scene, const Grains& grains);

/// Whether any of them does.
bool moves_boundaries(const Scene& scene);

/// The scene at t = 0: what held the grains until then is gone (the gate of a column, the plug of a
/// hopper), the plate of a shear cell lies on them and they are sheared, gravity is that of the
/// flow and boundaries begin to move.
Simulation release(const Simulation& deposited, const Scene& scene);

}  // namespace grseg
