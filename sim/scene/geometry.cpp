// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/geometry.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace grseg {

void require_within(double value, const std::string& key, double low, double high)
{
  require(
      value >= low && value <= high, key,
      fmt::format("{} is {:.6g}: it must lie between {:.6g} and {:.6g}", key, value, low, high));
}

Room room_at(const Scene& scene, double y)
{
  return scene.geometry->room_at ? scene.geometry->room_at(scene, y) : Room{0, scene.length};
}

double bed_area(const Scene& scene)
{
  if (scene.geometry->bed_area) return scene.geometry->bed_area(scene);
  const auto room = room_at(scene, 0);
  return scene.depth * (room.right - room.left);
}

Gravity<2> gravity_of(const Scene& scene)
{
  if (!scene.geometry->has_gravity) return {};
  const double slope = scene.slope * std::numbers::pi / 180;
  return {{scene.gravity * std::sin(slope), -scene.gravity * std::cos(slope)},
          scene.slope_rate * std::numbers::pi / 180};
}

std::vector<BoundaryBody> bodies_of(const Scene& scene, const Grains& grains)
{
  if (!scene.geometry->bodies) return {};
  return scene.geometry->bodies(scene, grains);
}

bool moves_boundaries(const Scene& scene)
{
  return !bodies_of(scene, {}).empty();
}

const std::vector<const Geometry*>& geometries()
{
  static const std::vector<const Geometry*> all{&bed_geometry, &drum_geometry, &shear_geometry,
                                                &column_geometry, &hopper_geometry};
  return all;
}

Simulation release(const Simulation& deposited, const Scene& scene)
{
  const auto change = scene.geometry->release;
  auto simulation = change ? change(deposited, scene) : deposited;
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
