// SPDX-License-Identifier: GPL-3.0-or-later
// A shear cell: at t = 0 gravity ends, and a plate of beads begins to press and shear the grains.
#include "sim/scene/geometry.hpp"
#include "sim/scene/packing.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grseg {
namespace {

/// Adds a row of beads that touches the highest grain; returns y of their centres, m.
double add_plate(Packing& packing, const Scene& scene)
{
  double top = 0;
  for (std::size_t g = 0; g < packing.position.size(); ++g)
    top = std::max(top, packing.position[g].y() + packing.grains.radius[g]);
  const double radius = bead_radius(scene);
  Boundaries plate;
  long line = 0;
  for (const double x : row_of_beads(scene)) add_bead(plate, scene, {x, top + radius}, line++);
  for (const auto& at : plate.position)
    add_grain(packing, Species::boundary, radius, scene.density, at);
  return top + radius;
}

/// Adds the velocities of a steady flow with a constant shear rate; otherwise the impact of the
/// plate would propagate through the grains. `height`: y of the plate's centres, m.
void add_shear_flow(Packing& packing, const Scene& scene, double height)
{
  for (std::size_t g = 0; g < packing.position.size(); ++g)
    if (!packing.grains.fixed[g])
      packing.velocity[g].x() += scene.plate_speed * packing.position[g].y() / height;
}

void resolve_shear_cell(Scene& scene, const KeyGiven& given)
{
  require(scene.lateral == Scene::Lateral::periodic, "lateral",
          "lateral is walls: a shear cell has no ends; set lateral = periodic");
  require(scene.base == Scene::Base::grains, "base",
          "base is wall: the plates of a shear cell are rough; set base = grains");
  scene.slope = 0;  // there is no gravity
  // With this gravity, the pressure of the bed on its base is about plate-pressure.
  if (!given("gravity")) scene.gravity = scene.plate_pressure / (scene.density * scene.depth);
  require(
      scene.gravity >= least_gravity && scene.gravity <= most_gravity, "plate-pressure",
      fmt::format("the deposition would have a gravity of {:.3g} m/s^2, to press like the plate; "
                  "set gravity, from {:g} to {:g}, or choose another plate-pressure",
                  scene.gravity, least_gravity, most_gravity));
}

void begin_to_shear(Packing& packing, const Scene& scene)
{
  const double height = add_plate(packing, scene);
  add_shear_flow(packing, scene, height);
}

std::vector<BoundaryBody> upper_plate(const Scene& scene, const Grains& grains)
{
  auto plate = body_of_beads(grains);
  plate.begin += (plate.end - plate.begin) / 2;  // the first half of the beads is the base
  plate.velocity = {scene.plate_speed, 0};
  plate.mass = scene.plate_mass;
  plate.load = -scene.plate_pressure * base_area(scene);
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
