// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <array>
#include <string>
#include <vector>

namespace grseg {

/// Relation of an axis x of the flow to an axis X of the archive: x = +-X + shift. `letter` is the
/// name of X; 0 if the axis of the flow is parallel to none.
struct AxisInArchive {
  char letter = 0;
  bool forward = true;
  double shift = 0;
};

/// A frame whose grains do not balance.
struct Imbalance {
  const Grains& grains;
  const Box& box;
  const Frame<3>& frame;
  const std::vector<Vec3>& defect;  // contact forces + m g - force of each grain, N
  double limit = 0;                 // largest defect of a grain that counts as balanced, N

  bool counts(std::size_t g) const
  {
    return is_mobile(grains, frame, g) && defect[g].norm() > limit;
  }
};

/// The likely cause of the imbalance, as part of a message; "" if none is visible in the archive.
/// The causes: most unbalanced grains are at a side of the bed and lack a push away from it (a wall
/// is missing); all contact forces are along their normals (the tangential part is missing); most
/// unbalanced grains overlap deeply (the bed is still filling).
std::string likely_cause(const Imbalance& imbalance, const std::array<AxisInArchive, 3>& axes);

/// Unlisted forces that would balance the grains, as part of a message; "" if none would. Tried are
/// opposite forces on the two grains of pairs without a listed force (bonds, or attraction across
/// gaps), and a drag on each grain, proportional to its velocity or momentum.
struct UnlistedForces {
  std::string sentence;
  bool acts_as_weight = false;  // true: a fitted gravity would absorb these forces
};

UnlistedForces unlisted_forces(const Imbalance& imbalance);

/// Late damping. Programs with velocity Verlet move grains by contact forces at the velocities of
/// mid-step, but some evaluate the forces again for output, with velocities half a step later
/// (LAMMPS: Pair::single()). The damping forces then differ, and grains do not balance, by
///   c m_eff (a_i - a_j) h/2 per contact, along the normal and, unless it slides, the tangent,
/// with coefficients c_n and c_t (1/s), the gamma_n and gamma_t of gran/hooke; h is the time step.
/// m_eff is m_i m_j/(m_i + m_j), or m_i at a boundary grain. a is the acceleration of a grain's
/// surface at the contact: of its centre, and along the tangent also by its angular acceleration.
struct LateDamping {
  double normal = 0, tangential = 0;  // c_n, c_t, 1/s: least-squares fit to the missing forces
};

/// Subtracts the effect of late damping from `defect` (contact forces + m g - force of each grain,
/// N). Its coefficients minimise the remaining defects and are not negative. `inertia` is I/(m
/// r^2); `frame.force` is required. A contact counts as sliding if friction over normal force is
/// within 1 % of the largest ratio.
LateDamping subtract_late_damping(const Grains& grains, const Frame<3>& frame, double step,
                                  double inertia, std::vector<Vec3>& defect);

}  // namespace grseg
