// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/contact/contact_law.hpp"
#include "sim/step/simulation.hpp"

#include <span>

namespace grseg {

/// Energies of the mobile grains, J (of discs per metre of depth): sums of m v^2/2; of I omega^2/2,
/// I = inertia_factor m r^2; and of -m g . x, which is zero at the origin.
template <int D>
double translational_energy(const Simulation<D>& simulation);
template <int D>
double rotational_energy(const Simulation<D>& simulation);
template <int D>
double potential_energy(const Simulation<D>& simulation);

/// Balance of the kinetic energy KE (J) over a step. The mid-point scheme obeys
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
template <int D>
EnergyBalance energy_balance(const Grains& grains, const Frame<D>& frame,
                             std::span<const Motion<D>> before, const Vector<D>& gravity,
                             double step);

}  // namespace grseg
