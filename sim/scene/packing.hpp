// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

}  // namespace grseg
