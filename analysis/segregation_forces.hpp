// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/momentum_balance.hpp"

#include <string>
#include <vector>

namespace grseg {

/// Which mechanism pushes the large grains which way: their momentum balance along y less their
/// part phi_L = rho^L/rho of the mixture's (a part of the mass; of the area where both species have
/// one density). Means over a layer; force densities on the large grains, N/m^2, upward positive:
/// the small grains feel the opposite. With yy of contact stress sigma and momentum flux K of the
/// mixture, psi and psi_K the large grains' parts of these, beta the interaction on large grains and
/// ' = d/dy less the force of the base (whose jump at the wall is no pressure gradient):
///
///   excess = rate^L - phi_L rate = push + push_kinetic + drag,   exactly
///   push = -(psi - phi_L) sigma'             = -phi_L phi_S B sigma'
///   push_kinetic = -(psi_K - phi_L) K'       = -phi_L phi_S B_K K'
///   drag = beta - spread - spread_kinetic,   spread = sigma psi', spread_kinetic = K psi_K'
///
/// `push` is the mechanism of Gray & Thornton (2005): with sigma' < 0, the weight of what lies
/// above, large grains go up if B > 0. `push_kinetic` is that of Fan & Hill (2011), Hill & Tan
/// (2014): where K' < 0, over a hot base, they go down if B_K < 0. `drag` is what both closures
/// leave to the resistance against the drift of the large grains. K counts from the frame of the
/// base; along y nothing but the dilation of the bed moves on the mean.
///
/// NaN where a species, or the stress that is shared, is missing.
struct SegregationForces {
  double phi, psi, psi_kinetic;
  double b, b_kinetic;
  double excess, push, push_kinetic, drag;
  double spread, spread_kinetic;
  double drift;  // kg/(m^2 s), rho^L (v^L - v) along y

  /// 1/s, c of drag = -c rho^L (v^L - v) (Gray & Thornton 2005). Of noise where the drift is small.
  double drag_rate() const { return -drag / drift; }
};

SegregationForces segregation_forces(const SpeciesMomentum& small, const SpeciesMomentum& large);

}  // namespace grseg
