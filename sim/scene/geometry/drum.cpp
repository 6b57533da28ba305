// SPDX-License-Identifier: GPL-3.0-or-later
// A drum: a rotating ring of beads.
#include "sim/scene/geometry.hpp"
#include "sim/scene/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

/// Position of the axis, m; y = 0 is the lowest point of the drum.
Vec2 centre_of(const Scene& scene)
{
  return {scene.length / 2, scene.drum_diameter / 2};
}

void resolve_drum(Scene& scene, const KeyGiven&)
{
  require(scene.lateral == Scene::Lateral::walls, "lateral",
          "lateral is periodic: a drum is closed; set lateral = walls");
  require(scene.base == Scene::Base::grains, "base",
          "base is wall: the wall of a drum is a ring of grains; set base = grains");
  require(scene.drum_diameter >= 4 * scene.large_diameter, "drum-diameter",
          "drum-diameter is below 4 d_L: large grains have no room to flow; choose a wider drum");
  scene.length = scene.drum_diameter + 2 * scene.large_diameter;
  scene.depth = scene.fill * scene.drum_diameter;
  require(scene.depth >= scene.small_diameter, "fill",
          fmt::format("fill is {:g}: the grains would be less than one small grain deep; choose a "
                      "larger fill or a wider drum",
                      scene.fill));
}

Boundaries ring_of_beads(const Scene& scene)
{
  Boundaries all;
  const double radius = bead_radius(scene), ring = scene.drum_diameter / 2 + radius;
  long beads = std::lround(std::floor(std::numbers::pi / std::asin(radius / ring)));
  if (scene.dimension == 3)  // even, so that lines interlock all around
    beads = 2 * std::lround(std::ceil(std::numbers::pi * ring / bead_spacing(scene)));
  for (long k = 0; k < beads; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(beads);
    add_bead(all, scene, centre_of(scene) + ring * Vec2(std::sin(angle), -std::cos(angle)), k);
  }
  add_walls_along_z(all, scene);
  return all;
}

Room room_in_drum(const Scene& scene, double y)
{
  const double radius = scene.drum_diameter / 2, away = y - radius;
  const double half = std::sqrt(std::max(0.0, radius * radius - away * away));
  return {centre_of(scene).x() - half, centre_of(scene).x() + half};
}

double area_in_drum(const Scene& scene)
{
  const double area = scene.fill * std::numbers::pi / 4 * scene.drum_diameter * scene.drum_diameter;
  return scene.dimension == 3 ? area * scene.width : area;
}

std::vector<BoundaryBody> turning_ring(const Scene& scene, const Grains& grains)
{
  auto drum = body_of_beads(grains);
  drum.centre = centre_of(scene);
  drum.spin = scene.drum_rate;
  drum.reach = scene.drum_diameter / 2;
  return {drum};
}

void describe_drum(const Scene& scene, Parameters& parameters)
{
  const auto centre = centre_of(scene);
  parameters.numbers["drum_centre"] = {centre.x(), centre.y()};
  parameters.numbers["drum_diameter"] = {scene.drum_diameter};
}

}  // namespace

const Geometry drum_geometry{.name = "drum",
                             .help = "rotating ring of grains",
                             .resolve = resolve_drum,
                             .boundaries = ring_of_beads,
                             .room_at = room_in_drum,
                             .bed_area = area_in_drum,
                             .checks_height = false,
                             .bodies = turning_ring,
                             .describe = describe_drum};

}  // namespace grseg
