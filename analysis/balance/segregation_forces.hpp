// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/balance/momentum_balance.hpp"

namespace grseg {

/// Which mechanism pushes the large grains which way: their momentum balance along y less their
/// part phi_L = rho^L/rho of the mixture's (a part of the mass; of the area where both species have
/// one density), so that gravity drops out. Means over a layer; force densities on the large
/// grains, N/m^2, upward positive: the small grains feel the opposite. With yy of contact stress
/// sigma and momentum flux K of the mixture, psi and psi_K the large grains' parts of these, beta
/// the interaction on large grains and ' = d/dy, less the force of the base in sigma' and (psi
/// sigma)' (the jump of stress at the wall is no pressure gradient), the balance reads, to
/// round-off,
///
///   rate^L - phi_L rate = push + push_kinetic + beta - spread - spread_kinetic
///   push         = -(psi - phi_L) sigma' = -phi_L phi_S B sigma'
///   push_kinetic = -(psi_K - phi_L) K'   = -phi_L phi_S B_K K'
///   spread = (psi sigma)' - psi sigma',  spread_kinetic = (psi_K K)' - psi_K K'
///
/// `push` is the mechanism of Gray & Thornton (2005): with sigma' < 0, the weight of what lies
/// above, large grains go up if B > 0. `push_kinetic` is that of Fan & Hill (2011), Hill & Tan
/// (2014): where K' < 0, over a hot base, they go down if B_K < 0. Both close the interaction by
/// beta = spread + spread_kinetic + drag. The rate of a few sampled steps scatters far more than
/// these terms, and beta with it; but what the rates sample is known, the change over the window
/// (MomentumBalance::change), and so is the mean drag:
///
///   drag    = change^L - phi_L change - push - push_kinetic
///   scatter = rate^L - phi_L rate less the same of `change`, of mean 0
///   beta    = spread + spread_kinetic + drag + scatter,   to round-off
///
/// K counts from the frame of the base; along y nothing but the dilation of the bed moves on the
/// mean. NaN where a species is missing; where no stress is shared its part is NaN and its push 0.
struct SegregationForces {
  double phi, psi, psi_kinetic;
  double b, b_kinetic;
  double push, push_kinetic, spread, spread_kinetic, drag, scatter;
  double drift;  // kg/(m^2 s), rho^L (v^L - v) along y

  /// 1/s, c of drag = -c rho^L (v^L - v) (Gray & Thornton 2005); noise where nothing drifts.
  double drag_rate() const { return -drag / drift; }
};

SegregationForces segregation_forces(const MomentumBalance& balance, std::size_t layer);

}  // namespace grseg
