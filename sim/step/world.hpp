// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/contact/contact_law.hpp"
#include "sim/neighbours/pair_list.hpp"
#include "sim/solver/boundary_body.hpp"
#include "sim/solver/solver.hpp"

#include <vector>

namespace grseg {

/// Mass of all mobile grains, kg.
inline double mobile_mass(const Grains& grains)
{
  double mass = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (!grains.fixed[g]) mass += grains.mass[g];
  return mass;
}

/// Everything that stays the same while a simulation runs.
template <int D>
struct World {
  Grains grains;
  std::vector<Wall<D>> walls;
  std::vector<BoundaryBody> bodies;  // boundary grains that move
  Box box;
  Material material;
  bool rotation = true;
  Vector<D> gravity = Vector<D>::Zero();  // m/s^2; if the slope changes, value of the last step
  double step = 0;                        // duration h of a step, s
  SolverSettings solver;
  LawParameters law;
  double skin = 0;  // m, of the pair list, above law.margin; 0: default
  int threads = 1;  // results do not depend on it
  /// Compute friction, restitution and periodicity even if the world has none: the same bytes in
  /// more time, for measurements and tests.
  bool general = false;
};

}  // namespace grseg
