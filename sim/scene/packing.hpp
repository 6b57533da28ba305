// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/geometry.hpp"
#include "sim/step/simulation.hpp"

#include <cstddef>
#include <vector>

namespace grseg {

/// Grains and walls of a scene in two or three dimensions; z is 0 for discs.
struct Packing {
  Grains grains;
  std::vector<Wall<3>> walls;
  Box box;
  std::vector<Vec3> position, velocity, spin;  // m, m/s, rad/s; per row of Grains
};

template <int D>
Packing packing_of(const Simulation<D>& simulation);

/// Simulation of a packing under the conditions of `scene` (set_conditions). Boundary grains are at
/// rest.
template <int D>
Simulation<D> simulation_of(const Packing& packing, const Scene& scene);

/// Appends a grain of `density` (kg/m^2, of spheres kg/m^3) at rest; boundary grains are fixed.
void add_grain(Packing& packing, Species species, double radius, double density, const Vec3& at);

/// Removes the last `count` grains.
void remove_last_grains(Packing& packing, std::size_t count);

// Parts of geometries: walls, and beads (boundary grains of the large nominal diameter).

double bead_radius(const Scene& scene);  // m, half the large nominal diameter

/// Adds a bead at (x, y), m; in three dimensions a line of touching or overlapping beads along z.
/// Beads of odd lines are shifted by half a bead, so that neighbouring lines interlock. At walls
/// along z, even lines touch the walls and odd lines reach halfway into them. Otherwise small grains
/// would wedge themselves between a moving bead and the wall.
void add_bead(Boundaries& to, const Scene& scene, const Vec2& at, long line = 0);

/// Distance of neighbouring beads or lines of beads that touch, m.
double bead_spacing(const Scene& scene);

/// Number of beads that add_bead() adds.
long beads_in_line(const Scene& scene, long line);

/// y of the centres of a regular row of beads in the base, m.
double height_of_base_centres(const Scene& scene);

/// Centres x, m, of a row of touching or nearly touching beads along the whole cell.
std::vector<double> row_of_beads(const Scene& scene);

/// Adds a base of beads with centres at `x`, m.
void add_bead_base(Boundaries& to, const Scene& scene, const std::vector<double>& x);

/// Adds walls at both ends of the cell along x if Scene::lateral is `walls`, and add_walls_along_z().
void add_side_walls(Boundaries& to, const Scene& scene);

/// Adds walls at both ends of the cell along z, of spheres, if Scene::sides is `walls`.
void add_walls_along_z(Boundaries& to, const Scene& scene);

/// A base along the whole cell (beads or a straight wall, see Scene::base), and side walls.
Boundaries base_and_sides(const Scene& scene);

/// All boundary grains of `grains` (its last rows) as one body at rest.
BoundaryBody body_of_beads(const Grains& grains);

}  // namespace grseg
