// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/geometry.hpp"
#include "sim/step/simulation.hpp"

#include <cstddef>
#include <vector>

namespace grseg {

/// Grains where they are, m, in their world.
struct Packing {
  World world;
  std::vector<Vec2> position;
};

Packing packing_of(const Simulation& simulation);

/// Appends a grain of `density` (kg/m^2); grains of the boundary are fixed.
void add_grain(Packing& packing, Species species, double radius, double density, const Vec2& at);

/// Removes the last `count` grains.
void remove_last_grains(Packing& packing, std::size_t count);

/// A simulation of `packing` whose mobile grains move as the same rows of `before` do.
Simulation set_in_motion(const Packing& packing, const Simulation& before);

// Parts that geometries are built from: beads (boundary grains of the large nominal diameter) and
// walls.

double bead_radius(const Scene& scene);  // m

void add_bead(Boundaries& to, const Scene& scene, const Vec2& at);

/// y of the centres of beads in the base, m.
double height_of_base_centres(const Scene& scene);

/// x of a row of touching or nearly touching beads along the whole cell, m.
std::vector<double> row_of_beads(const Scene& scene);

/// A base of beads at `x`, m.
void add_bead_base(Boundaries& to, const Scene& scene, const std::vector<double>& x);

/// Walls at both ends of the cell, where Scene::lateral says so.
void add_side_walls(Boundaries& to, const Scene& scene);

/// A base along the whole cell (a row of beads, or a straight wall, as Scene::base says), and walls
/// at both ends as above.
Boundaries base_and_sides(const Scene& scene);

/// All boundary grains of `grains`, which are its last rows, as one body at rest.
BoundaryBody body_of_beads(const Grains& grains);

}  // namespace grseg
