// SPDX-License-Identifier: GPL-3.0-or-later
// A shear cell: at t = 0 gravity ends, and a plate of beads begins to press and shear the grains.
#include "sim/scene/geometry.hpp"
#include "sim/scene/packing.hpp"

#include <algorithm>

namespace grseg {
namespace {

/// Adds a row of beads that touches the highest grain.
void add_plate(Packing& packing, const Scene& scene)
{
  double top = 0;
  for (std::size_t g = 0; g < packing.position.size(); ++g)
    top = std::max(top, packing.position[g].y() + packing.world.grains.radius[g]);
  const double radius = bead_radius(scene);
  for (const double x : row_of_beads(scene))
    add_grain(packing, Species::boundary, radius, scene.density, {x, top + radius});
}

/// Adds the velocities of a steady flow of constant shear rate. Otherwise the start of the plate
/// would send an impact through the grains.
void add_shear_flow(Simulation& simulation, const Scene& scene)
{
  const auto& fixed = simulation.world().grains.fixed;
  const double height = simulation.position(fixed.size() - 1).y();  // m, y of the plate
  for (std::size_t g = 0; g < fixed.size(); ++g) {
    if (fixed[g]) continue;
    const double speed = scene.plate_speed * simulation.position(g).y() / height;
    simulation.set_velocity(g, simulation.velocity(g) + Vec2(speed, 0),
                            simulation.angular_velocity(g));
  }
}

void resolve_shear_cell(Scene& scene, const KeyGiven& given)
{
  require(scene.lateral == Scene::Lateral::periodic, "lateral",
          "lateral is walls: a shear cell has no ends; set lateral = periodic");
  require(scene.base == Scene::Base::grains, "base",
          "base is wall: the plates of a shear cell are rough; set base = grains");
  require(scene.slope_rate == 0, "slope-rate",
          "slope-rate turns gravity, and a shear cell has no gravity; leave it out");
  // With this gravity, the pressure of the bed on its base is about plate-pressure.
  if (!given("gravity")) scene.gravity = scene.plate_pressure / (scene.density * scene.depth);
}

Simulation begin_to_shear(const Simulation& deposited, const Scene& scene)
{
  auto packing = packing_of(deposited);
  add_plate(packing, scene);
  auto simulation = set_in_motion(packing, deposited);
  add_shear_flow(simulation, scene);
  return simulation;
}

std::vector<BoundaryBody> upper_plate(const Scene& scene, const Grains& grains)
{
  auto plate = body_of_beads(grains);
  plate.begin += (plate.end - plate.begin) / 2;  // the first half of the beads is the base
  plate.velocity = {scene.plate_speed, 0};
  plate.mass = scene.plate_mass;
  plate.load = -scene.plate_pressure * scene.length;
  return {plate};
}

}  // namespace

const Geometry shear_geometry{
    .name = "shear",
    .help = "between plates, without gravity",
    .resolve = resolve_shear_cell,
    .boundaries = base_and_sides,
    .release = begin_to_shear,
    .keeps_grains = false,
    .has_free_body = true,
    .bodies = upper_plate,
    .has_gravity = false,
    .base_pressure = [](const Scene& scene) { return scene.plate_pressure; }};

}  // namespace grseg
