// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/driving_forces.hpp"

#include <limits>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// A species with a smaller share reaches the layer only by the tail of the kernel.
constexpr double least_part = 1e-9;

/// A stress that both species share and its derivative along y.
struct Shared {
  double small, large;              // N/m or Pa
  double slope_small, slope_large;  // N/m^2 or N/m^3

  double part() const { return small + large > 0 ? large / (small + large) : nan; }
  /// 0 where there is no stress to share.
  double push(double phi) const
  {
    return small + large > 0 ? -(part() - phi) * (slope_small + slope_large) : 0;
  }
  /// (psi sigma)' - psi sigma'.
  double spread(double phi) const
  {
    return slope_large - phi * (slope_small + slope_large) + push(phi);
  }
};

}  // namespace

template <int D>
DrivingForces driving_forces(const MomentumBalance<D>& balance, std::size_t layer)
{
  const auto small = balance.mean(layer, Species::small);
  const auto large = balance.mean(layer, Species::large);
  const Shared contact{small.contact_stress(1, 1), large.contact_stress(1, 1),
                       -(small.contact + small.base).y(), -(large.contact + large.base).y()};
  const Shared kinetic{small.momentum_flux(1, 1), large.momentum_flux(1, 1), -small.kinetic.y(),
                       -large.kinetic.y()};
  DrivingForces of{};
  of.phi = large.density / (small.density + large.density);
  if (!(of.phi > least_part && of.phi < 1 - least_part)) of.phi = nan;
  of.psi = contact.part();
  of.psi_kinetic = kinetic.part();
  of.b = (of.psi - of.phi) / (of.phi * (1 - of.phi));
  of.b_kinetic = (of.psi_kinetic - of.phi) / (of.phi * (1 - of.phi));
  of.push = contact.push(of.phi);
  of.push_kinetic = kinetic.push(of.phi);
  of.spread = contact.spread(of.phi);
  of.spread_kinetic = kinetic.spread(of.phi);

  const auto beyond_mixture = [&](const Vector<D>& of_large, const Vector<D>& of_small) {
    return of_large.y() - of.phi * (of_large + of_small).y();
  };
  const double change =
      beyond_mixture(balance.change(layer, Species::large), balance.change(layer, Species::small));
  of.drag = change - of.push - of.push_kinetic;
  of.scatter = beyond_mixture(large.rate, small.rate) - change;
  of.drift = beyond_mixture(large.momentum, small.momentum);
  return of;
}

template DrivingForces driving_forces(const MomentumBalance<2>&, std::size_t);
template DrivingForces driving_forces(const MomentumBalance<3>&, std::size_t);

}  // namespace grseg
