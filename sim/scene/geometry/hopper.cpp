// SPDX-License-Identifier: GPL-3.0-or-later
// A bed over an outlet in its base; a plug of beads closes it until t = 0.
#include "sim/scene/geometry.hpp"
#include "sim/scene/packing.hpp"

#include <cmath>

namespace grseg {
namespace {

/// Beads of the base, and of the plug that closes the outlet.
struct BaseAndPlug {
  Boundaries base, plug;
};

/// x of the beads that close a slot, m. Between lines of spheres they are evenly spaced.
std::vector<double> plug_of_slot(const Scene& scene)
{
  const bool lines = scene.dimension == 3;
  const double width = scene.outlet + (lines ? scene.large_diameter : 0);
  const long gaps = std::lround(std::ceil(width / bead_spacing(scene)));
  const double spacing = width / static_cast<double>(gaps), left = (scene.length - width) / 2;
  std::vector<double> x;
  for (long k = lines ? 1 : 0; k < gaps; ++k)
    x.push_back(left + (static_cast<double>(k) + (lines ? 0 : 0.5)) * spacing);
  return x;
}

/// A slot: beads fill the base from its edges to the walls. Lines are numbered so that neighbours
/// interlock.
BaseAndPlug around_slot(const Scene& scene)
{
  BaseAndPlug beads;
  const double y = height_of_base_centres(scene), middle = scene.length / 2;
  const double half = bead_spacing(scene) / 2, edge = scene.outlet / 2 + bead_radius(scene) - half;
  const auto plug = plug_of_slot(scene);
  const long beside = std::lround(std::ceil((middle - scene.outlet / 2) / (2 * half)));
  for (const double side : {-1.0, 1.0})
    for (long k = 0; k < beside; ++k)
      add_bead(beads.base, scene,
               {middle + side * (edge + (2 * static_cast<double>(k) + 1) * half), y},
               side < 0 ? -1 - k : static_cast<long>(plug.size()) + k);
  for (std::size_t k = 0; k < plug.size(); ++k)
    add_bead(beads.plug, scene, {plug[k], y}, static_cast<long>(k));
  return beads;
}

/// A round outlet, of spheres: a regular base without the beads that would reach into it.
BaseAndPlug around_circle(const Scene& scene)
{
  Boundaries all;
  add_bead_base(all, scene, row_of_beads(scene));
  BaseAndPlug beads;
  const Vec3 middle(scene.length / 2, height_of_base_centres(scene), scene.width / 2);
  for (std::size_t k = 0; k < all.position.size(); ++k) {
    const bool inside = (all.position[k] - middle).norm() < scene.outlet / 2 + all.radius[k];
    auto& to = inside ? beads.plug : beads.base;
    to.position.push_back(all.position[k]);
    to.radius.push_back(all.radius[k]);
  }
  return beads;
}

BaseAndPlug base_and_plug(const Scene& scene)
{
  return scene.outlet_shape == Scene::Outlet::round ? around_circle(scene) : around_slot(scene);
}

void resolve_hopper(Scene& scene, const KeyGiven&)
{
  require(scene.lateral == Scene::Lateral::walls, "lateral",
          "lateral is periodic: a hopper needs walls; set lateral = walls");
  require(scene.base == Scene::Base::grains, "base",
          "base is wall: the outlet of a hopper is a gap in a row of grains; set base = grains");
  require(scene.outlet < scene.length, "outlet",
          "outlet is not below length: no base would be left; choose a narrower outlet");
  if (scene.outlet_shape != Scene::Outlet::round) return;
  require(scene.outlet < scene.width, "outlet",
          "outlet is not below width: no base would be left; choose a narrower outlet");
}

Boundaries hopper_boundaries(const Scene& scene)
{
  auto [all, plug] = base_and_plug(scene);
  all.top = height_of_base_centres(scene) + bead_radius(scene);
  add_side_walls(all, scene);
  all.walls.push_back({{0, -1.3 * scene.depth, 0}, Vec3::UnitY()});  // stops grains that have left
  all.position.insert(all.position.end(), plug.position.begin(), plug.position.end());
  all.radius.insert(all.radius.end(), plug.radius.begin(), plug.radius.end());
  return all;
}

void open_outlet(Packing& packing, const Scene& scene)
{
  remove_last_grains(packing, base_and_plug(scene).plug.position.size());
}

}  // namespace

const Geometry hopper_geometry{.name = "hopper",
                               .help = "its outlet opens at t = 0",
                               .resolve = resolve_hopper,
                               .boundaries = hopper_boundaries,
                               .release = open_outlet,
                               .keeps_grains = false};

}  // namespace grseg
