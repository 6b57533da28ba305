// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/release.hpp"

#include "sim/scene/geometry.hpp"

namespace grseg {

Simulation release(const Simulation& deposited, const Scene& scene)
{
  auto simulation = scene.geometry->release(deposited, scene);
  simulation.set_clock(0);
  start_flow(simulation, scene);
  return simulation;
}

void start_flow(Simulation& simulation, const Scene& scene)
{
  simulation.tilt(gravity_of(scene));
  simulation.drive(bodies_of(scene, simulation.world().grains));
}

}  // namespace grseg
