// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/energies.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

double squared(double spin)
{
  return spin * spin;
}
double squared(const Vec3& spin)
{
  return spin.squaredNorm();
}

/// rim x n: velocity of a surface point by rotation. `rim`: radius times angular velocity.
Vec2 turned(double rim, const Vec2& n)
{
  return rim * Vec2(-n.y(), n.x());
}
Vec3 turned(const Vec3& rim, const Vec3& n)
{
  return rim.cross(n);
}

template <int D>
double kinetic_energy(double mass, const Vector<D>& velocity, const Spin<D>& rim)
{
  return mass * (velocity.squaredNorm() / 2 + squared(rim) * (inertia_factor<D> / 2));
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

template <int D>
double translational_energy(const Simulation<D>& s)
{
  const auto& grains = s.world().grains;
  return total(grains,
               [&](std::size_t g) { return grains.mass[g] * s.velocity(g).squaredNorm() / 2; });
}

template <int D>
double rotational_energy(const Simulation<D>& s)
{
  const auto& grains = s.world().grains;
  return total(grains, [&](std::size_t g) {
    const auto rim = vector_of(s.motion(g).rim);
    return (grains.mass[g] * rim).dot(rim) * (inertia_factor<D> / 2);
  });
}

template <int D>
double potential_energy(const Simulation<D>& s)
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

template <int D>
EnergyBalance energy_balance(const Grains& grains, const Frame<D>& frame,
                             std::span<const Motion<D>> before, const Vector<D>& gravity,
                             double step)
{
  EnergyBalance balance;
  // Means of the values before and after the step.
  std::vector<Vector<D>> velocity(grains.size());
  std::vector<Spin<D>> rim(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const Vector<D> first = vector_of(before[g].v);
    const Spin<D> rim_before = spin_of<D>(before[g].rim),
                  rim_after = frame.angular_velocity[g] * grains.radius[g];
    velocity[g] = (first + frame.velocity[g]) / 2;
    rim[g] = (rim_before + rim_after) / 2;
    if (grains.fixed[g]) continue;
    balance.kinetic_before += kinetic_energy<D>(grains.mass[g], first, rim_before);
    balance.kinetic_after += kinetic_energy<D>(grains.mass[g], frame.velocity[g], rim_after);
    balance.work_of_gravity += step * grains.mass[g] * gravity.dot(velocity[g]);
  }
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const Vector<D> n = contacts.branch[c].normalized();
    Vector<D> relative = velocity[i];
    Spin<D> rims = rim[i];
    double kappa = 1;
    if (contacts.j[c] >= 0) {
      const auto j = static_cast<std::size_t>(contacts.j[c]);
      relative -= velocity[j];
      rims += rim[j];
      kappa = contacts.branch[c].norm() / (grains.radius[i] + grains.radius[j]);
      if (grains.fixed[j])
        balance.work_of_boundaries +=
            step * contacts.force[c].dot(velocity[j] + turned(kappa * rim[j], n));
    }
    relative -= turned(kappa * rims, n);
    balance.work_of_contacts += step * contacts.force[c].dot(relative);
  }
  return balance;
}

template double translational_energy(const Simulation<2>&);
template double rotational_energy(const Simulation<2>&);
template double potential_energy(const Simulation<2>&);
template EnergyBalance energy_balance<2>(const Grains&, const Frame<2>&, std::span<const Motion<2>>,
                                         const Vector<2>&, double);
template double translational_energy(const Simulation<3>&);
template double rotational_energy(const Simulation<3>&);
template double potential_energy(const Simulation<3>&);
template EnergyBalance energy_balance<3>(const Grains&, const Frame<3>&, std::span<const Motion<3>>,
                                         const Vector<3>&, double);

}  // namespace grseg
