// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/geometry.hpp"

#include <cmath>
#include <numbers>

namespace grseg {

Room Geometry::room_at(const Scene& scene, double) const
{
  return {0, scene.length};
}

double Geometry::bed_area(const Scene& scene) const
{
  const auto room = room_at(scene, 0);
  return scene.depth * (room.right - room.left);
}

Simulation Geometry::release(const Simulation& deposited, const Scene&) const
{
  return deposited;
}

std::vector<BoundaryBody> Geometry::bodies(const Scene&, const Grains&) const
{
  return {};
}

Gravity<2> Geometry::gravity(const Scene& scene) const
{
  const double slope = scene.slope * std::numbers::pi / 180;
  return {{scene.gravity * std::sin(slope), -scene.gravity * std::cos(slope)},
          scene.slope_rate * std::numbers::pi / 180};
}

double Geometry::base_pressure(const Scene&, double weight) const
{
  return weight;
}

void Geometry::describe(const Scene&, Parameters&) const {}

std::vector<BoundaryBody> bodies_of(const Scene& scene, const Grains& grains)
{
  return scene.geometry->bodies(scene, grains);
}

bool moves_boundaries(const Scene& scene)
{
  return !bodies_of(scene, {}).empty();
}

const std::vector<const Geometry*>& geometries()
{
  static const std::vector<const Geometry*> all{
      &bed_geometry(), &drum_geometry(), &shear_geometry(), &column_geometry(), &hopper_geometry()};
  return all;
}

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
