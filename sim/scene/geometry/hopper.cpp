// SPDX-License-Identifier: GPL-3.0-or-later
// A bed over an outlet in its base; a plug of beads closes it until t = 0.
#include "sim/scene/geometry.hpp"
#include "sim/scene/packing.hpp"

#include <cmath>

namespace grseg {
namespace {

/// x of the beads on both sides of the outlet, from its edges to the walls, m.
std::vector<double> row_with_outlet(const Scene& scene)
{
  const double middle = scene.length / 2;
  std::vector<double> x;
  const double half = bead_spacing(scene) / 2;
  const long beads = std::lround(std::ceil((middle - scene.outlet / 2) / (2 * half)));
  for (const double side : {-1.0, 1.0})
    for (long k = 0; k < beads; ++k)
      x.push_back(middle + side * (scene.outlet / 2 + (2 * static_cast<double>(k) + 1) * half));
  return x;
}

/// x of the beads that close the outlet, m.
std::vector<double> plug(const Scene& scene)
{
  const long beads = std::lround(std::ceil(scene.outlet / bead_spacing(scene)));
  const double spacing = scene.outlet / static_cast<double>(beads);
  std::vector<double> x;
  for (long k = 0; k < beads; ++k)
    x.push_back((scene.length - scene.outlet) / 2 + (static_cast<double>(k) + 0.5) * spacing);
  return x;
}

void add_plug(Boundaries& to, const Scene& scene)
{
  long line = 0;
  for (const double x : plug(scene))
    add_bead(to, scene, {x, height_of_base_centres(scene)}, line++);
}

void resolve_hopper(Scene& scene, const KeyGiven&)
{
  require(scene.lateral == Scene::Lateral::walls, "lateral",
          "lateral is periodic: a hopper needs walls; set lateral = walls");
  require(scene.base == Scene::Base::grains, "base",
          "base is wall: the outlet of a hopper is a gap in a row of grains; set base = grains");
  require(scene.outlet < scene.length, "outlet",
          "outlet is not below length: no base would be left; choose a narrower outlet");
}

Boundaries hopper_boundaries(const Scene& scene)
{
  Boundaries all;
  add_bead_base(all, scene, row_with_outlet(scene));
  add_side_walls(all, scene);
  all.walls.push_back({{0, -1.3 * scene.depth, 0}, Vec3::UnitY()});  // stops grains that have left
  add_plug(all, scene);
  return all;
}

void open_outlet(Packing& packing, const Scene& scene)
{
  Boundaries in_outlet;
  add_plug(in_outlet, scene);
  remove_last_grains(packing, in_outlet.position.size());
}

}  // namespace

const Geometry hopper_geometry{.name = "hopper",
                               .help = "its outlet opens at t = 0",
                               .resolve = resolve_hopper,
                               .boundaries = hopper_boundaries,
                               .release = open_outlet,
                               .keeps_grains = false};

}  // namespace grseg
