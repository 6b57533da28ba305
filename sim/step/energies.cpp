// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/energies.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

double kinetic_energy(double mass, const Vec2& velocity, double rim_speed)
{
  return mass * (velocity.squaredNorm() / 2 + rim_speed * rim_speed / 4);
}

/// Sum of energy_of(g), J, over the mobile grains.
template <class Energy>
double total(const Grains& grains, const Energy& energy_of)
{
  double energy = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (!grains.fixed[g]) energy += energy_of(g);
  return energy;
}

}  // namespace

double translational_energy(const Simulation& s)
{
  const auto& grains = s.world().grains;
  return total(grains,
               [&](std::size_t g) { return grains.mass[g] * s.velocity(g).squaredNorm() / 2; });
}

double rotational_energy(const Simulation& s)
{
  const auto& grains = s.world().grains;
  return total(grains, [&](std::size_t g) {
    return grains.mass[g] * s.motion(g).rim_speed * s.motion(g).rim_speed / 4;
  });
}

double potential_energy(const Simulation& s)
{
  const auto& grains = s.world().grains;
  return total(grains, [&](std::size_t g) {
    return -grains.mass[g] * s.world().gravity.dot(s.position(g));
  });
}

double EnergyBalance::defect() const
{
  const double missing =
      kinetic_after - kinetic_before - work_of_gravity - work_of_contacts - work_of_boundaries;
  const double largest = std::max({kinetic_before, kinetic_after, std::abs(work_of_gravity),
                                   std::abs(work_of_contacts), std::abs(work_of_boundaries)});
  return largest > 0 ? std::abs(missing) / largest : 0;
}

EnergyBalance energy_balance(const Grains& grains, const Frame<2>& frame,
                             std::span<const Motion> before, const Vec2& gravity, double step)
{
  EnergyBalance balance;
  // Means of the values before and after the step.
  std::vector<Vec2> velocity(grains.size());
  std::vector<double> rim_speed(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const Vec2 first{before[g].vx, before[g].vy};
    const double rim_after = frame.angular_velocity[g] * grains.radius[g];
    velocity[g] = (first + frame.velocity[g]) / 2;
    rim_speed[g] = (before[g].rim_speed + rim_after) / 2;
    if (grains.fixed[g]) continue;
    balance.kinetic_before += kinetic_energy(grains.mass[g], first, before[g].rim_speed);
    balance.kinetic_after += kinetic_energy(grains.mass[g], frame.velocity[g], rim_after);
    balance.work_of_gravity += step * grains.mass[g] * gravity.dot(velocity[g]);
  }
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const Vec2 n = contacts.branch[c].normalized(), t{-n.y(), n.x()};
    Vec2 relative = velocity[i];
    double rims = rim_speed[i], kappa = 1;
    if (contacts.j[c] >= 0) {
      const auto j = static_cast<std::size_t>(contacts.j[c]);
      relative -= velocity[j];
      rims += rim_speed[j];
      kappa = contacts.branch[c].norm() / (grains.radius[i] + grains.radius[j]);
      if (grains.fixed[j])
        balance.work_of_boundaries +=
            step * contacts.force[c].dot(velocity[j] + kappa * rim_speed[j] * t);
    }
    relative -= kappa * rims * t;
    balance.work_of_contacts += step * contacts.force[c].dot(relative);
  }
  return balance;
}

}  // namespace grseg
