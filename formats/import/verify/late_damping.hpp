// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <vector>

namespace grseg {

/// Programs that step by velocity Verlet move grains by contact forces at the velocities of
/// mid-step, but some re-evaluate the forces for output, with velocities half a step later
/// (LAMMPS: Pair::single()). Damping then differs, and grains do not balance, by
///   c m_eff (a_i - a_j) h/2 per contact, along the normal and, where it does not slide, the
///   tangent,
/// with coefficients c_n and c_t (1/s) that are those of gran/hooke's gamma_n and gamma_t. m_eff is
/// m_i m_j/(m_i + m_j), at a boundary grain m_i; a is the acceleration, of the rims along the
/// tangent.
struct LateDamping {
  double normal = 0, tangential = 0;  // c, 1/s; least squares of the missing forces
};

/// Subtracts from `defect` (N, per grain: contact forces + m g - force) what late damping explains:
/// the coefficients, not negative, that minimise the rest. `inertia` is I/(m r^2); `frame.force` is
/// required. A contact counts as sliding where friction over normal force is within 1 % of its
/// largest value.
LateDamping subtract_late_damping(const Grains& grains, const Frame<3>& frame, double step,
                                  double inertia, std::vector<Vec3>& defect);

}  // namespace grseg
