// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/contact/contact_law.hpp"
#include "sim/step/simulation.hpp"

#include <span>

namespace grseg {

/// Energies of the mobile grains, J (per metre of depth): sums of m v^2/2; of I omega^2/2 with I =
/// m r^2/2; and of -m g . x, which is zero at the origin.
double translational_energy(const Simulation& simulation);
double rotational_energy(const Simulation& simulation);
double potential_energy(const Simulation& simulation);

/// Balance of the kinetic energy KE (J per metre of depth) over a step. The mid-point scheme obeys
/// KE' - KE = sum m g h . (v + v')/2 + sum p . (u + u')/2 to round-off, with p the impulse of a
/// contact and u the relative velocity of the two surfaces at the contact; a prime means after the
/// step (theta = 1/2; Acary & Brogliato 2008, section 10.1). Negative work of contacts is
/// dissipation; the work of moving boundaries on the grains is a term of its own.
struct EnergyBalance {
  double kinetic_before = 0, kinetic_after = 0, work_of_gravity = 0, work_of_contacts = 0,
         work_of_boundaries = 0;

  /// Error of the balance over its largest term; 0 if nothing moves.
  double defect() const;
};

/// `before` is the motion of each grain at the beginning of the step in `frame`.
EnergyBalance energy_balance(const Grains& grains, const Frame<2>& frame,
                             std::span<const Motion> before, const Vec2& gravity, double step);

}  // namespace grseg
