// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/balance/momentum_balance.hpp"

#include <tuple>

namespace grseg {

/// Forces that drive segregation, with mixed contacts cut at the contact point: the large grains'
/// momentum balance along y, less m_L = rho^L/rho times the mixture's balance. Gravity drops out.
/// phi_L, their share of the area or volume, is the same where all grains have one density. Means
/// over a layer; force densities on the large grains, N/m^2 or N/m^3, upward positive; the small
/// grains feel the opposite. sigma and K are the yy components of contact stress and momentum flux
/// of the mixture, psi and psi_K the large grains' shares of them, beta the interaction on large
/// grains and ' = d/dy. sigma' and (psi sigma)' leave out the force of the base, since the jump of
/// stress at the wall is not a pressure gradient. Then, to round-off,
///
///   rate^L - m_L rate = push + push_kinetic + beta - spread - spread_kinetic
///   push         = -(psi - m_L) sigma' = -phi_L phi_S B sigma' - (phi_L - m_L) sigma'
///   push_kinetic = -(psi_K - m_L) K'   = -phi_L phi_S B_K K' - (phi_L - m_L) K'
///   spread = (psi sigma)' - psi sigma',  spread_kinetic = (psi_K K)' - psi_K K'
///
/// with psi = phi_L (1 + B phi_S), psi_K likewise with B_K (Staron & Phillips 2015, eqs. 3 and 6).
/// `push` is the mechanism of Gray & Thornton (2005): sigma' < 0, since stress carries the weight
/// above, so large grains rise if B > 0. `push_kinetic` is the mechanism of Fan & Hill (2011) and
/// Hill & Tan (2014): where K' < 0, above a hot base, large grains sink if B_K < 0. Both theories
/// close the interaction by beta = spread + spread_kinetic + drag. The rate of a few sampled steps
/// scatters far more than these terms, and so does beta; but the change over the window that the
/// rates sample is known (MomentumBalance::change), and with it the mean drag:
///
///   drag    = change^L - m_L change - push - push_kinetic
///   scatter = rate^L - m_L rate less the same of `change`, of mean 0
///   beta    = spread + spread_kinetic + drag + scatter,   to round-off
///
/// K is taken in the frame of the base; along y the mean motion is only the dilation of the bed.
/// NaN where a species is missing; without a stress to share, the share is NaN and the push 0.
struct DrivingForces {
  double phi, mass_share, psi, psi_kinetic;
  double b, b_kinetic;
  double push, push_kinetic, spread, spread_kinetic, drag, scatter;
  double drift;  // kg/(m s) or kg/(m^2 s), rho^L (v^L - v) along y

  /// 1/s, c of drag = -c rho^L (v^L - v) (Gray & Thornton 2005); noise where nothing drifts.
  double drag_rate() const { return -drag / drift; }
};

/// Forces in one layer of a run with two species.
template <int D>
DrivingForces driving_forces(const MomentumBalance<D>& balance, std::size_t layer);

/// Forces that depend on the partition rule, for two species in one layer: the share psi of the
/// contact stress, and with it B, push, spread and drag; the kinetic terms, the change and the
/// scatter are the same under all rules. The mixture's sigma' is -(N^S + N^L), under any rule, and
///
///   beta = spread + spread_kinetic + drag + scatter,   to round-off, by that rule's beta and drag.
///
/// `drag` closes the balance, whatever the rule: it is what is left, not a measured force.
/// NaN as in DrivingForces; B of `drop`, whose stresses do not add up to the whole, is NaN.
struct RuleForces {
  double psi, b, push, spread, drag;
};
template <int D>
RuleForces rule_forces(const DrivingForces& forces, const PartitionedBalance<D>& contacts,
                       std::size_t layer, std::size_t rule);

/// The contact push on the large grains where they get the share p of the stress that every mixed
/// contact has in the layer: linear in p, push = (all - none) (p - p*), from `none` at p = 0 to
/// `all` at p = 1; N/m^2 or N/m^3. RuleForces give each grain the stress along its own stretch of
/// the branch, which is the same at 0 and 1 and differs little in between.
struct PushOverShare {
  double none = 0, all = 0;
  static constexpr auto members = std::tuple(&PushOverShare::none, &PushOverShare::all);

  /// p*, at which the push changes its sign; without mixed contacts not a number.
  double zero() const { return none / (none - all); }
};
template <int D>
PushOverShare push_over_share(const DrivingForces& forces, const PartitionedBalance<D>& contacts,
                              std::size_t layer);

}  // namespace grseg
