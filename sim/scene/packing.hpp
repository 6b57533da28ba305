// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/geometry.hpp"
#include "sim/step/simulation.hpp"

#include <cstddef>
#include <vector>

namespace grseg {

/// World with the positions of its grains, m.
struct Packing {
  World world;
  std::vector<Vec2> position;
};

Packing packing_of(const Simulation& simulation);

/// Appends a grain. `radius` in m, `density` in kg/m^2; boundary grains are fixed.
void add_grain(Packing& packing, Species species, double radius, double density, const Vec2& at);

/// Removes the last `count` grains.
void remove_last_grains(Packing& packing, std::size_t count);

/// Simulation of `packing`. Its mobile grains get the velocities of the same rows of `before`.
Simulation set_in_motion(const Packing& packing, const Simulation& before);

// Parts of geometries: walls, and beads (boundary grains of the large nominal diameter).

double bead_radius(const Scene& scene);  // m, half the large nominal diameter

void add_bead(Boundaries& to, const Scene& scene, const Vec2& at);

/// y of the centres of a regular row of beads in the base, m.
double height_of_base_centres(const Scene& scene);

/// Centres x, m, of a row of touching or nearly touching beads along the whole cell.
std::vector<double> row_of_beads(const Scene& scene);

/// Adds a base of beads with centres at `x`, m.
void add_bead_base(Boundaries& to, const Scene& scene, const std::vector<double>& x);

/// Adds walls at both ends of the cell if Scene::lateral is `walls`.
void add_side_walls(Boundaries& to, const Scene& scene);

/// A base along the whole cell (beads or a straight wall, see Scene::base), and side walls.
Boundaries base_and_sides(const Scene& scene);

/// All boundary grains of `grains` (its last rows) as one body at rest.
BoundaryBody body_of_beads(const Grains& grains);

}  // namespace grseg
