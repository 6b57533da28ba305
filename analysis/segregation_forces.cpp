// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation_forces.hpp"

#include <limits>

namespace grseg {
namespace {

/// The large grains' part of something that is positive where it is there at all.
double part(double small, double large)
{
  const double total = small + large;
  return total > 0 ? large / total : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

SegregationForces segregation_forces(const SpeciesMomentum& small, const SpeciesMomentum& large)
{
  SegregationForces of{};
  of.phi = part(small.density, large.density);
  of.psi = part(small.contact_stress(1, 1), large.contact_stress(1, 1));
  of.psi_kinetic = part(small.momentum_flux(1, 1), large.momentum_flux(1, 1));
  const double both = of.phi * (1 - of.phi);
  of.b = (of.psi - of.phi) / both;
  of.b_kinetic = (of.psi_kinetic - of.phi) / both;

  const double gradient_large = -(large.contact + large.base).y();
  const double gradient = gradient_large - (small.contact + small.base).y();
  const double kinetic_large = -large.kinetic.y(), kinetic = kinetic_large - small.kinetic.y();
  of.excess = large.rate.y() - of.phi * (large.rate + small.rate).y();
  of.push = -(of.psi - of.phi) * gradient;
  of.push_kinetic = -(of.psi_kinetic - of.phi) * kinetic;
  of.spread = gradient_large - of.psi * gradient;
  of.spread_kinetic = kinetic_large - of.psi_kinetic * kinetic;
  of.drag = large.interaction.y() - of.spread - of.spread_kinetic;
  of.drift = large.momentum.y() - of.phi * (large.momentum + small.momentum).y();
  return of;
}

}  // namespace grseg
