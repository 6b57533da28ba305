// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/packing.hpp"

#include "sim/scene/base_row.hpp"

#include <algorithm>
#include <cmath>
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

double bead_radius(const Scene& scene)
{
  return scene.large_diameter / 2;
}

void add_bead(Boundaries& to, const Scene& scene, const Vec2& at)
{
  to.position.push_back(at);
  to.radius.push_back(bead_radius(scene));
}

double height_of_base_centres(const Scene& scene)
{
  return scene.origin == Scene::Origin::top ? -bead_radius(scene) : 0;
}

std::vector<double> row_of_beads(const Scene& scene)
{
  const long beads = beads_at_spacing(scene, scene.large_diameter);
  const double spacing = scene.length / static_cast<double>(beads);
  std::vector<double> x;
  for (long k = 0; k < beads; ++k) x.push_back((static_cast<double>(k) + 0.5) * spacing);
  return x;
}

void add_bead_base(Boundaries& to, const Scene& scene, const std::vector<double>& x)
{
  const double y = height_of_base_centres(scene);
  for (const double at : x) add_bead(to, scene, {at, y});
  to.top = y + bead_radius(scene);
}

void add_side_walls(Boundaries& to, const Scene& scene)
{
  if (scene.lateral != Scene::Lateral::walls) return;
  to.walls.push_back({{0, 0}, {1, 0}});
  to.walls.push_back({{scene.length, 0}, {-1, 0}});
}

Boundaries base_and_sides(const Scene& scene)
{
  Boundaries all;
  if (scene.base == Scene::Base::wall)
    all.walls.push_back({{0, 0}, {0, 1}});
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
