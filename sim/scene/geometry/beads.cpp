// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/geometry/beads.hpp"

#include "sim/scene/geometry/base_row.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {

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

void add_base(Boundaries& to, const Scene& scene)
{
  if (scene.base == Scene::Base::wall)
    to.walls.push_back({{0, 0}, {0, 1}});
  else
    add_base_row(to, scene);
}

void add_side_walls(Boundaries& to, const Scene& scene)
{
  if (scene.lateral != Scene::Lateral::walls) return;
  to.walls.push_back({{0, 0}, {1, 0}});
  to.walls.push_back({{scene.length, 0}, {-1, 0}});
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
