// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/geometry.hpp"

#include "sim/scene/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
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
  const double area = scene.depth * (room.right - room.left);
  return scene.dimension == 3 ? area * scene.width : area;
}

template <int D>
Gravity<D> gravity_of(const Scene& scene)
{
  if (!scene.geometry->has_gravity) return {};
  const double slope = scene.slope * std::numbers::pi / 180;
  Vector<D> gravity = Vector<D>::Zero();
  gravity.template head<2>() << scene.gravity * std::sin(slope), -scene.gravity * std::cos(slope);
  return {gravity, scene.slope_rate * std::numbers::pi / 180};
}

std::vector<BoundaryBody> bodies_of(const Scene& scene, const Grains& grains)
{
  if (!scene.geometry->bodies) return {};
  return scene.geometry->bodies(scene, grains);
}

double largest_acceleration(const Scene& scene)
{
  double largest = scene.gravity;
  for (const auto& body : bodies_of(scene, {}))
    largest = std::max({largest, largest_acceleration(body),
                        std::abs(body.load) / (scene.density * bed_area(scene))});
  return largest;
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

template <int D>
Simulation<D> release(const Simulation<D>& deposited, const Scene& scene)
{
  auto simulation = deposited;
  if (scene.geometry->release) {
    auto packing = packing_of(deposited);
    scene.geometry->release(packing, scene);
    simulation = simulation_of<D>(packing, scene);
  }
  simulation.set_clock(0);
  start_flow(simulation, scene);
  return simulation;
}

template <int D>
void start_flow(Simulation<D>& simulation, const Scene& scene)
{
  simulation.tilt(gravity_of<D>(scene));
  simulation.drive(bodies_of(scene, simulation.world().grains));
}

template Gravity<2> gravity_of(const Scene&);
template Gravity<3> gravity_of(const Scene&);
template Simulation<2> release(const Simulation<2>&, const Scene&);
template Simulation<3> release(const Simulation<3>&, const Scene&);
template void start_flow(Simulation<2>&, const Scene&);
template void start_flow(Simulation<3>&, const Scene&);

}  // namespace grseg
