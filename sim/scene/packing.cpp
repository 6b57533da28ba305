// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/packing.hpp"

#include "sim/scene/base_row.hpp"
#include "sim/scene/deposition.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {

template <int D>
Packing packing_of(const Simulation<D>& simulation)
{
  const auto& world = simulation.world();
  Packing packing{world.grains, {}, world.box, {}, {}, {}};
  const auto in_space = [](const Vector<D>& v) {
    Vec3 all = Vec3::Zero();
    all.head<D>() = v;
    return all;
  };
  for (const auto& wall : world.walls)
    packing.walls.push_back({in_space(wall.point), in_space(wall.normal)});
  for (std::size_t g = 0; g < world.grains.size(); ++g) {
    packing.position.push_back(in_space(simulation.position(g)));
    packing.velocity.push_back(in_space(simulation.velocity(g)));
    auto& spin = packing.spin.emplace_back(Vec3::Zero());
    if constexpr (D == 2)
      spin.z() = simulation.angular_velocity(g);
    else
      spin = simulation.angular_velocity(g);
  }
  return packing;
}

template <int D>
Simulation<D> simulation_of(const Packing& packing, const Scene& scene)
{
  World<D> world;
  world.grains = packing.grains;
  world.box = packing.box;
  for (const auto& wall : packing.walls)
    world.walls.push_back({wall.point.head<D>(), wall.normal.head<D>()});
  set_conditions(world, scene);
  std::vector<Vector<D>> position;
  for (const auto& x : packing.position) position.push_back(x.head<D>());
  Simulation<D> simulation(world, position);
  for (std::size_t g = 0; g < position.size(); ++g) {
    if (packing.grains.fixed[g]) continue;
    if constexpr (D == 2)
      simulation.set_velocity(g, packing.velocity[g].head<2>(), packing.spin[g].z());
    else
      simulation.set_velocity(g, packing.velocity[g], packing.spin[g]);
  }
  return simulation;
}

template Packing packing_of(const Simulation<2>&);
template Packing packing_of(const Simulation<3>&);
template Simulation<2> simulation_of(const Packing&, const Scene&);
template Simulation<3> simulation_of(const Packing&, const Scene&);

void add_grain(Packing& packing, Species species, double radius, double density, const Vec3& at)
{
  auto& grains = packing.grains;
  grains.id.push_back(static_cast<std::int32_t>(grains.size()));
  grains.species.push_back(species);
  grains.radius.push_back(radius);
  grains.mass.push_back(packing.box.dimension == 3 ? density * grain_volume<3>(radius)
                                                   : density * std::numbers::pi * radius * radius);
  grains.fixed.push_back(species == Species::boundary);
  packing.position.push_back(at);
  packing.velocity.push_back(Vec3::Zero());
  packing.spin.push_back(Vec3::Zero());
}

void remove_last_grains(Packing& packing, std::size_t count)
{
  auto& grains = packing.grains;
  const auto left = grains.size() - count;
  grains.id.resize(left), grains.species.resize(left), grains.radius.resize(left);
  grains.mass.resize(left), grains.fixed.resize(left), packing.position.resize(left);
  packing.velocity.resize(left), packing.spin.resize(left);
}

double bead_radius(const Scene& scene)
{
  return scene.large_diameter / 2;
}

double bead_spacing(const Scene& scene)
{
  return scene.dimension == 3 ? std::sqrt(0.75) * scene.large_diameter : scene.large_diameter;
}

long beads_in_line(const Scene& scene, long line)
{
  if (scene.dimension == 2) return 1;
  const long beads = std::lround(std::ceil(scene.width / scene.large_diameter - 1e-9));
  return scene.sides == Scene::Lateral::walls && line % 2 != 0 ? beads + 1 : beads;
}

void add_bead(Boundaries& to, const Scene& scene, const Vec2& at, long line)
{
  const double spacing = scene.width / static_cast<double>(beads_in_line(scene, 0));
  const double quarter = scene.sides == Scene::Lateral::walls ? 0.25 : 0;
  const double first = line % 2 == 0 ? 0.25 + quarter : 0.75 - 3 * quarter;
  for (long k = 0; k < beads_in_line(scene, line); ++k) {
    const double z = scene.dimension == 3 ? (static_cast<double>(k) + first) * spacing : 0;
    to.position.emplace_back(at.x(), at.y(), z);
    to.radius.push_back(bead_radius(scene));
  }
}

double height_of_base_centres(const Scene& scene)
{
  return scene.origin == Scene::Origin::top ? -bead_radius(scene) : 0;
}

std::vector<double> row_of_beads(const Scene& scene)
{
  long beads = beads_at_spacing(scene, scene.large_diameter);
  if (scene.dimension == 3)  // even, so that lines interlock across the period
    beads = 2 * std::lround(std::ceil(scene.length / bead_spacing(scene) / 2 - 1e-9));
  const double spacing = scene.length / static_cast<double>(beads);
  std::vector<double> x;
  for (long k = 0; k < beads; ++k) x.push_back((static_cast<double>(k) + 0.5) * spacing);
  return x;
}

void add_bead_base(Boundaries& to, const Scene& scene, const std::vector<double>& x)
{
  const double y = height_of_base_centres(scene);
  long line = 0;
  for (const double at : x) add_bead(to, scene, {at, y}, line++);
  lower_spheres(to, scene);
  to.top = y + bead_radius(scene);
}

void add_side_walls(Boundaries& to, const Scene& scene)
{
  if (scene.lateral == Scene::Lateral::walls) {
    to.walls.push_back({Vec3::Zero(), Vec3::UnitX()});
    to.walls.push_back({{scene.length, 0, 0}, Vec3(-1, 0, 0)});
  }
  add_walls_along_z(to, scene);
}

void add_walls_along_z(Boundaries& to, const Scene& scene)
{
  if (scene.dimension == 2 || scene.sides != Scene::Lateral::walls) return;
  to.walls.push_back({Vec3::Zero(), Vec3::UnitZ()});
  to.walls.push_back({{0, 0, scene.width}, Vec3(0, 0, -1)});
}

Boundaries base_and_sides(const Scene& scene)
{
  Boundaries all;
  if (scene.base == Scene::Base::wall)
    all.walls.push_back({Vec3::Zero(), Vec3::UnitY()});
  else if (scene.dimension == 3)
    add_bead_base(all, scene, row_of_beads(scene));
  else
    add_base_row(all, scene);
  add_side_walls(all, scene);
  return all;
}

BoundaryBody body_of_beads(const Grains& grains)
{
  BoundaryBody body;
  body.begin = static_cast<std::uint32_t>(std::find(grains.fixed.begin(), grains.fixed.end(), 1) -
                                          grains.fixed.begin());
  body.end = static_cast<std::uint32_t>(grains.size());
  return body;
}

}  // namespace grseg
