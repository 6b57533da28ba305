// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/energies.hpp"

namespace grseg {

double translational_energy(const Simulation& s)
{
  const auto& grains = s.world().grains;
  double energy = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (!grains.fixed[g]) energy += grains.mass[g] * s.velocity(g).squaredNorm() / 2;
  return energy;
}

double rotational_energy(const Simulation& s)
{
  const auto& grains = s.world().grains;
  double energy = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const double speed = s.motion(g).rim_speed;
    if (!grains.fixed[g]) energy += grains.mass[g] * speed * speed / 4;
  }
  return energy;
}

double potential_energy(const Simulation& s)
{
  const auto& grains = s.world().grains;
  double energy = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (!grains.fixed[g]) energy -= grains.mass[g] * s.world().gravity.dot(s.position(g));
  return energy;
}

}  // namespace grseg
