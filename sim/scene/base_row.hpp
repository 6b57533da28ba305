// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/geometry.hpp"

/// The row of beads (boundary grains) under a bed, set by the keys base-... With the default values
/// of these keys, and in all other geometries, the row is regular: touching beads of the large
/// grains' diameter.
///
/// N beads fill the cell: the largest N whose mean spacing, length/N, is at least base-spacing.
/// Spacings, diameters and heights with a spread are evenly spaced values of their ranges, assigned
/// to the beads in random order: ranges and means are exact, and values of neighbouring beads are
/// independent. The top of the highest bead is at y = 0, of the lowest at -base-height-spread; with
/// Scene::Origin::centre, both are half a base-diameter higher. The order has random numbers of its
/// own, so that the falling grains are the same as over a regular base.
///
/// Beads may overlap (unequal neighbours, or base-spacing below base-diameter): there are no
/// contacts between beads, because neither can move.
namespace grseg {

/// Sets Scene::base_spacing to the mean spacing that fills the cell (base-diameter is the default
/// of the key). Throws SceneError if the geometry has no such base, if its beads are too large for
/// the cell, or if the smallest grain would fall through.
void resolve_base_row(Scene& scene, const KeyGiven& given);

/// Spheres have a base of interlocked lines of touching large grains, or a wall. Throws SceneError
/// if the smallest grain would fall through the lines.
void check_base_of_spheres(const Scene& scene);

/// Lowers each of the spheres of a base by a distance from 0 to base-height-spread, as in a row.
void lower_spheres(Boundaries& base, const Scene& scene);

/// Largest number of beads that fill the cell with a mean spacing of at least `spacing`, m.
long beads_at_spacing(const Scene& scene, double spacing);

/// Largest possible gap between neighbouring beads, or bead and side wall, m; below 0: overlap.
double widest_gap(const Scene& scene);

/// Adds the row of beads, and sets `to.top` to the top of its highest bead.
void add_base_row(Boundaries& to, const Scene& scene);

}  // namespace grseg
