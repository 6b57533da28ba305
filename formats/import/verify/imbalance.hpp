// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <array>
#include <string>
#include <vector>

namespace grseg {

/// Place of an axis of the flow in the archive: x = +-X + shift. No letter: along none of its axes.
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
  const std::vector<Vec3>& defect;  // of each grain, N: contact forces + m g - force
  double limit = 0;                 // a larger defect counts

  bool counts(std::size_t g) const
  {
    return is_mobile(grains, frame, g) && defect[g].norm() > limit;
  }
};

/// The cause, visible in the archive itself, why grains do not balance, as part of a sentence, ""
/// where none is: most of them lie at a face of the bed, away from which they are pushed (a wall is
/// missing); all contact forces are along their normals (the tangential part is missing); they
/// overlap deeply (a bed that is being filled).
std::string likely_cause(const Imbalance& imbalance, const std::array<AxisInArchive, 3>& axes);

/// Forces that the archive does not list and that would balance its grains, as part of a sentence;
/// "" where none of these would: forces along pairs that bear none in the list, opposite on the two
/// grains (bonds, or contacts that pull beyond touch); a drag on each grain, in proportion to its
/// velocity or its momentum.
struct UnlistedForces {
  std::string sentence;
  bool acts_as_weight = false;  // gravity found from the grains would be wrong by them
};

UnlistedForces unlisted_forces(const Imbalance& imbalance);

/// Programs that step by velocity Verlet move grains by contact forces at the velocities of
/// mid-step, but some re-evaluate the forces for output, with velocities half a step later
/// (LAMMPS: Pair::single()). Damping then differs, and grains do not balance, by
///   c m_eff (a_i - a_j) h/2 per contact, along the normal and, where it does not slide, the
///   tangent,
/// with coefficients c_n and c_t (1/s), the gamma_n and gamma_t of gran/hooke. m_eff is
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
