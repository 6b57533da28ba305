// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/step/simulation.hpp"

namespace grseg {

/// Energies of the mobile grains, J (per metre of depth): sum of m v^2/2, of I omega^2/2 with
/// I = m r^2/2, and of -m g . x, which is zero at the origin.
double translational_energy(const Simulation& simulation);
double rotational_energy(const Simulation& simulation);
double potential_energy(const Simulation& simulation);

}  // namespace grseg
