// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/driving_forces.hpp"

#include "analysis/frames/sums.hpp"

namespace grseg {
namespace {

// Least share of a species. Below it only the tail of the kernel of its grains reaches the layer.
constexpr double least_part = 1e-9;

/// The yy components of a stress of both species, and their derivatives along y.
struct Shared {
  double small, large;              // stress of each species, N/m or Pa
  double slope_small, slope_large;  // its derivative, N/m^2 or N/m^3

  double part() const { return small + large > 0 ? large / (small + large) : no_number; }
  /// The push -(psi - phi) sigma'; 0 if there is no stress.
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
  of.phi = large.content / (small.content + large.content);
  of.mass_share = large.density / (small.density + large.density);
  if (!(of.phi > least_part && of.phi < 1 - least_part)) of.phi = of.mass_share = no_number;
  of.psi = contact.part();
  of.psi_kinetic = kinetic.part();
  of.b = (of.psi - of.phi) / (of.phi * (1 - of.phi));
  of.b_kinetic = (of.psi_kinetic - of.phi) / (of.phi * (1 - of.phi));
  of.push = contact.push(of.mass_share);
  of.push_kinetic = kinetic.push(of.mass_share);
  of.spread = contact.spread(of.mass_share);
  of.spread_kinetic = kinetic.spread(of.mass_share);

  const auto beyond_mixture = [&](const Vector<D>& of_large, const Vector<D>& of_small) {
    return of_large.y() - of.mass_share * (of_large + of_small).y();
  };
  const double change =
      beyond_mixture(balance.change(layer, Species::large), balance.change(layer, Species::small));
  of.drag = change - of.push - of.push_kinetic;
  of.scatter = beyond_mixture(large.rate, small.rate) - change;
  of.drift = beyond_mixture(large.momentum, small.momentum);
  return of;
}

namespace {

/// The push -(psi - phi) `slope`, N/m^2 or N/m^3. `slope` is the derivative of the mixture's stress
/// `total`, and psi the large grains' share of this stress. 0 if there is no stress.
double push_of(double psi, double phi, double total, double slope)
{
  return total > 0 ? -(psi - phi) * slope : 0;
}

/// The yy component of the mixture's contact stress and its derivative along y, for any rule.
template <int D>
struct Mixture {
  Mixture(const PartitionedBalance<D>& contacts, std::size_t layer)
      : stress((contacts.unmixed_stress(layer, Species::small) +
                contacts.unmixed_stress(layer, Species::large) +
                contacts.mixed_stress(layer))(1, 1)),
        slope(-(contacts.contact_force(layer, Species::small) +
                contacts.contact_force(layer, Species::large))
                   .y())
  {
  }
  double stress, slope;
};

}  // namespace

template <int D>
RuleForces rule_forces(const DrivingForces& forces, const PartitionedBalance<D>& contacts,
                       std::size_t layer, std::size_t rule)
{
  const Mixture mixture(contacts, layer);
  const auto large = contacts.mean(layer, Species::large, rule);
  RuleForces of{};
  of.psi = mixture.stress > 0 ? large.stress(1, 1) / mixture.stress : no_number;
  const bool adds_up = contacts.rules()[rule].adds_up();
  of.b = adds_up ? (of.psi - forces.phi) / (forces.phi * (1 - forces.phi)) : no_number;
  of.push = push_of(of.psi, forces.mass_share, mixture.stress, mixture.slope);
  of.spread = -(large.contact + large.base).y() - forces.mass_share * mixture.slope + of.push;
  of.drag = forces.drag + forces.push - of.push;
  return of;
}

template <int D>
PushOverShare push_over_share(const DrivingForces& forces, const PartitionedBalance<D>& contacts,
                              std::size_t layer)
{
  const Mixture mixture(contacts, layer);
  const double own = contacts.unmixed_stress(layer, Species::large)(1, 1);
  const double mixed = contacts.mixed_stress(layer)(1, 1);
  const auto push = [&](double stress) {
    return push_of(stress / mixture.stress, forces.mass_share, mixture.stress, mixture.slope);
  };
  return {push(own), push(own + mixed)};
}

template RuleForces rule_forces(const DrivingForces&, const PartitionedBalance<2>&, std::size_t,
                                std::size_t);
template RuleForces rule_forces(const DrivingForces&, const PartitionedBalance<3>&, std::size_t,
                                std::size_t);
template PushOverShare push_over_share(const DrivingForces&, const PartitionedBalance<2>&,
                                       std::size_t);
template PushOverShare push_over_share(const DrivingForces&, const PartitionedBalance<3>&,
                                       std::size_t);
template DrivingForces driving_forces(const MomentumBalance<2>&, std::size_t);
template DrivingForces driving_forces(const MomentumBalance<3>&, std::size_t);

}  // namespace grseg
