// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/geometry.hpp"

/// The row of beads (boundary grains) under a bed: the keys base-... Other geometries have the
/// regular row that these keys give by default: touching beads of the large grains' diameter.
///
/// N beads fill the cell, where N is the largest number whose mean spacing, length/N, is not below
/// base-spacing. Spacings, diameters and heights that spread are evenly spaced values of their
/// range, which the beads take in random order: ranges and means are exact, and no bead knows its
/// neighbours. Tops lie at y = 0, or below it by what a bead is lowered: the highest one at 0, the
/// lowest one at -base-height-spread; with Scene::Origin::centre, half a base-diameter above that.
/// The random order has a stream of its own, so that grains fall as over a regular base.
///
/// Beads may overlap (unequal neighbours, or base-spacing below base-diameter): they never
/// touch each other in the sense of the contact law, since both stand still.
namespace grseg {

/// Sets Scene::base_spacing, which `given` may leave open, to the mean spacing that fills the
/// cell. SceneError where the keys ask for a base that this geometry does not have, that the cell
/// does not hold, or that lets the smallest grain through.
void resolve_base_row(Scene& scene, const KeyGiven& given);

/// How many beads fill the cell with a mean spacing that is not below `spacing`, m.
long beads_at_spacing(const Scene& scene, double spacing);

/// Largest gap between neighbours, beads or a wall, that the keys allow, m; below 0 where all
/// overlap.
double widest_gap(const Scene& scene);

/// Adds the row, and sets `to.top` to the top of its highest bead.
void add_base_row(Boundaries& to, const Scene& scene);

}  // namespace grseg
