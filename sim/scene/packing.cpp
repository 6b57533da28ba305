// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/packing.hpp"

#include <numbers>

namespace grseg {

Packing packing_of(const Simulation& simulation)
{
  Packing packing{simulation.world(), {}};
  for (std::size_t g = 0; g < packing.world.grains.size(); ++g)
    packing.position.push_back(simulation.position(g));
  return packing;
}

void add_grain(Packing& packing, Species species, double radius, double density, const Vec2& at)
{
  auto& grains = packing.world.grains;
  grains.id.push_back(static_cast<std::int32_t>(grains.size()));
  grains.species.push_back(species);
  grains.radius.push_back(radius);
  grains.mass.push_back(density * std::numbers::pi * radius * radius);
  grains.fixed.push_back(species == Species::boundary);
  packing.position.push_back(at);
}

void remove_last_grains(Packing& packing, std::size_t count)
{
  auto& grains = packing.world.grains;
  const auto left = grains.size() - count;
  grains.id.resize(left), grains.species.resize(left), grains.radius.resize(left);
  grains.mass.resize(left), grains.fixed.resize(left), packing.position.resize(left);
}

Simulation set_in_motion(const Packing& packing, const Simulation& before)
{
  Simulation simulation(packing.world, packing.position);
  for (std::size_t g = 0; g < packing.position.size(); ++g)
    if (!packing.world.grains.fixed[g])
      simulation.set_velocity(g, before.velocity(g), before.angular_velocity(g));
  return simulation;
}

}  // namespace grseg
