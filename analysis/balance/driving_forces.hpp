// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/balance/momentum_balance.hpp"

#include <tuple>

namespace grseg {

/// Forces that drive segregation, with mixed contacts cut at the contact point: the large grains'
/// momentum balance along y minus m_L = rho^L/rho times the mixture's balance. Gravity cancels. m_L
/// equals phi_L, the large grains' share of area or volume, if all grains have one density. The
/// forces are means over a layer of force densities on the large grains, N/m^2 or N/m^3, positive
/// upward; small grains have the opposite ones.
///
/// sigma and K are the yy components of contact stress and momentum flux of the mixture, psi and
/// psi_K the large grains' shares of them, beta the interaction on large grains and ' = d/dy.
/// sigma' and (psi sigma)' leave out the force of the base, because the jump of stress at the wall
/// is not a pressure gradient. Then, to round-off,
///
///   rate^L - m_L rate = push + push_kinetic + beta - spread - spread_kinetic
///   push         = -(psi - m_L) sigma' = -phi_L phi_S B sigma' - (phi_L - m_L) sigma'
///   push_kinetic = -(psi_K - m_L) K'   = -phi_L phi_S B_K K' - (phi_L - m_L) K'
///   spread = (psi sigma)' - psi sigma',  spread_kinetic = (psi_K K)' - psi_K K'
///
/// with psi = phi_L (1 + B phi_S), psi_K likewise with B_K (Staron & Phillips 2015, eqs. 3 and 6).
/// `push` is the mechanism of Gray & Thornton (2005): sigma' < 0, because stress carries the weight
/// above, so large grains rise if B > 0. `push_kinetic` is the mechanism of Fan & Hill (2011) and
/// Hill & Tan (2014): if K' < 0, above a hot base, large grains sink if B_K < 0. Both theories
/// model the interaction as beta = spread + spread_kinetic + drag. The rate of a few sampled steps,
/// and with it beta, fluctuates far more than these terms. But the change over the window, the
/// expectation of the rates, is known (MomentumBalance::change), and with it the mean drag:
///
///   drag    = change^L - m_L change - push - push_kinetic
///   scatter = (rate^L - change^L) - m_L (rate - change),   a fluctuation of mean 0
///   beta    = spread + spread_kinetic + drag + scatter,   to round-off
///
/// K is the flux relative to the base; along y the mean motion is only the dilation of the bed. All
/// are NaN if a species is missing. If there is no stress, psi is NaN and the push 0.
struct DrivingForces {
  double phi, mass_share, psi, psi_kinetic;
  double b, b_kinetic;
  double push, push_kinetic, spread, spread_kinetic, drag, scatter;
  double drift;  // rho^L (v^L - v) along y, kg/(m s) or kg/(m^2 s)

  /// c in drag = -c rho^L (v^L - v), 1/s (Gray & Thornton 2005); only noise if nothing drifts.
  double drag_rate() const { return -drag / drift; }
};

/// Forces in one layer of a run with two species.
template <int D>
DrivingForces driving_forces(const MomentumBalance<D>& balance, std::size_t layer);

/// Forces that depend on the partition rule, for two species in one layer: the share psi of the
/// contact stress, and with it B, push, spread and drag. The kinetic terms, the change and the
/// scatter are the same under all rules. The mixture's sigma' is -(N^S + N^L) under any rule, and
///
///   beta = spread + spread_kinetic + drag + scatter,   to round-off, with beta and drag by rule.
///
/// `drag` is the rest of the balance under any rule, not a measured force. NaN as in DrivingForces.
/// B is also NaN for `drop`, because its stresses do not add up to the total.
struct RuleForces {
  double psi, b, push, spread, drag;
};
template <int D>
RuleForces rule_forces(const DrivingForces& forces, const PartitionedBalance<D>& contacts,
                       std::size_t layer, std::size_t rule);

/// The contact push on the large grains as a function of their share p of the stress of every mixed
/// contact in the layer, N/m^2 or N/m^3. It is linear: push = (all - none) (p - p*), with the
/// values `none` at p = 0 and `all` at p = 1. RuleForces differ slightly for p between 0 and 1,
/// because they distribute each grain's part of the stress along its own stretch of the branch.
struct PushOverShare {
  double none = 0, all = 0;
  static constexpr auto members = std::tuple(&PushOverShare::none, &PushOverShare::all);

  /// The share p* at which the push changes its sign; NaN without mixed contacts.
  double zero() const { return none / (none - all); }
};
template <int D>
PushOverShare push_over_share(const DrivingForces& forces, const PartitionedBalance<D>& contacts,
                              std::size_t layer);

}  // namespace grseg
