// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/boundaries.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

using Geometry = Scene::Geometry;

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

/// A row of touching or nearly touching beads along the whole cell.
std::vector<double> row_of_beads(const Scene& scene)
{
  const long beads = std::lround(std::floor(scene.length / scene.large_diameter + 1e-9));
  const double spacing = scene.length / static_cast<double>(beads);
  std::vector<double> x;
  for (long k = 0; k < beads; ++k) x.push_back((static_cast<double>(k) + 0.5) * spacing);
  return x;
}

/// The beads beside the outlet, from its edges to the walls, and then the plug that closes it.
std::vector<double> row_with_outlet(const Scene& scene)
{
  const double radius = bead_radius(scene), middle = scene.length / 2;
  std::vector<double> x;
  const long beads = std::lround(std::ceil((middle - scene.outlet / 2) / (2 * radius)));
  for (const double side : {-1.0, 1.0})
    for (long k = 0; k < beads; ++k)
      x.push_back(middle + side * (scene.outlet / 2 + (2 * static_cast<double>(k) + 1) * radius));
  return x;
}

std::vector<double> plug(const Scene& scene)
{
  const long beads = std::lround(std::ceil(scene.outlet / scene.large_diameter));
  const double gap = scene.outlet / static_cast<double>(beads);
  std::vector<double> x;
  for (long k = 0; k < beads; ++k)
    x.push_back((scene.length - scene.outlet) / 2 + (static_cast<double>(k) + 0.5) * gap);
  return x;
}

void add_drum(Boundaries& to, const Scene& scene)
{
  const double radius = bead_radius(scene), ring = scene.drum_diameter / 2 + radius;
  const long beads = std::lround(std::floor(std::numbers::pi / std::asin(radius / ring)));
  for (long k = 0; k < beads; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(beads);
    add_bead(to, scene, drum_centre(scene) + ring * Vec2(std::sin(angle), -std::cos(angle)));
  }
}

void add_side_walls(Boundaries& to, const Scene& scene)
{
  to.walls.push_back({{0, 0}, {1, 0}});
  to.walls.push_back({{scene.length, 0}, {-1, 0}});
}

void add_base(Boundaries& to, const Scene& scene)
{
  if (scene.base == Scene::Base::wall) {
    to.walls.push_back({{0, 0}, {0, 1}});
    return;
  }
  const double y = height_of_base_centres(scene);
  for (const double x :
       scene.geometry == Geometry::hopper ? row_with_outlet(scene) : row_of_beads(scene))
    add_bead(to, scene, {x, y});
  to.top = y + bead_radius(scene);
}

/// The grains of `deposited` but the last `less` of them, where they are and as they move.
struct Bed {
  World world;
  std::vector<Vec2> position;

  Bed(const Simulation& deposited, std::size_t less) : world(deposited.world())
  {
    auto& g = world.grains;
    const auto count = g.size() - less;
    g.id.resize(count), g.species.resize(count), g.radius.resize(count), g.mass.resize(count);
    g.fixed.resize(count);
    for (std::size_t k = 0; k < count; ++k) position.push_back(deposited.position(k));
  }
  /// A plate of beads that touches the highest grain.
  void add_plate(const Scene& scene)
  {
    auto& g = world.grains;
    double top = 0;
    for (std::size_t k = 0; k < g.size(); ++k) top = std::max(top, position[k].y() + g.radius[k]);
    const double radius = bead_radius(scene);
    for (const double x : row_of_beads(scene)) {
      g.id.push_back(static_cast<std::int32_t>(g.size()));
      g.species.push_back(Species::boundary);
      g.radius.push_back(radius);
      g.mass.push_back(scene.density * std::numbers::pi * radius * radius);
      g.fixed.push_back(1);
      position.emplace_back(x, top + radius);
    }
  }
};

/// Lets the grains move as they would in a steady flow of constant shear rate, so that no impact of
/// the plate runs through them.
void shear(Simulation& simulation, const Scene& scene)
{
  const auto& fixed = simulation.world().grains.fixed;
  const double height = simulation.position(fixed.size() - 1).y();  // of the plate's centres
  for (std::size_t g = 0; g < fixed.size(); ++g) {
    if (fixed[g]) continue;
    const double speed = scene.plate_speed * simulation.position(g).y() / height;
    simulation.set_velocity(g, simulation.velocity(g) + Vec2(speed, 0),
                            simulation.angular_velocity(g));
  }
}

Simulation go_on_with(const Bed& bed, const Simulation& deposited)
{
  Simulation simulation(bed.world, bed.position);
  for (std::size_t g = 0; g < bed.position.size(); ++g)
    if (!bed.world.grains.fixed[g])
      simulation.set_velocity(g, deposited.velocity(g), deposited.angular_velocity(g));
  return simulation;
}

}  // namespace

Boundaries boundaries_of(const Scene& scene)
{
  Boundaries all;
  if (scene.geometry == Geometry::drum) {
    add_drum(all, scene);
    return all;
  }
  add_base(all, scene);
  if (scene.lateral == Scene::Lateral::walls) add_side_walls(all, scene);
  // What is to go comes last.
  if (scene.geometry == Geometry::column) all.walls.push_back({{scene.column_width, 0}, {-1, 0}});
  if (scene.geometry == Geometry::hopper) {
    all.walls.push_back({{0, -1.3 * scene.depth}, {0, 1}});  // catches what has left
    for (const double x : plug(scene)) add_bead(all, scene, {x, height_of_base_centres(scene)});
  }
  return all;
}

Room room_at(const Scene& scene, double y)
{
  if (scene.geometry == Geometry::column) return {0, scene.column_width};
  if (scene.geometry != Geometry::drum) return {0, scene.length};
  const double radius = scene.drum_diameter / 2, away = y - radius;
  const double half = std::sqrt(std::max(0.0, radius * radius - away * away));
  return {drum_centre(scene).x() - half, drum_centre(scene).x() + half};
}

bool moves_boundaries(const Scene& scene)
{
  return !bodies_of(scene, {}).empty();
}

std::vector<BoundaryBody> bodies_of(const Scene& scene, const Grains& grains)
{
  const auto count = static_cast<std::uint32_t>(grains.size());
  const auto first = static_cast<std::uint32_t>(
      std::find(grains.fixed.begin(), grains.fixed.end(), 1) - grains.fixed.begin());
  BoundaryBody body;
  body.begin = first;
  body.end = count;
  switch (scene.geometry) {
    case Geometry::drum:
      body.centre = drum_centre(scene);
      body.spin = scene.drum_rate;
      return {body};
    case Geometry::shear: {
      body.begin = first + (count - first) / 2;  // as many beads as the base has
      body.velocity = {scene.plate_speed, 0};
      body.mass = scene.plate_mass;
      body.load = -scene.plate_pressure * scene.length;
      return {body};
    }
    default:
      if (scene.shake_amplitude == 0) return {};
      body.amplitude = {0, scene.shake_amplitude};
      body.angular_frequency = 2 * std::numbers::pi * scene.shake_frequency;
      return {body};
  }
}

Simulation release(const Simulation& deposited, const Scene& scene)
{
  auto simulation = deposited;
  if (scene.geometry == Geometry::column) {
    Bed bed(deposited, 0);
    bed.world.walls.pop_back();
    simulation = go_on_with(bed, deposited);
  } else if (scene.geometry == Geometry::hopper) {
    simulation = go_on_with(Bed(deposited, plug(scene).size()), deposited);
  } else if (scene.geometry == Geometry::shear) {
    Bed bed(deposited, 0);
    bed.add_plate(scene);
    simulation = go_on_with(bed, deposited);
    shear(simulation, scene);
  }
  simulation.set_clock(0);
  simulation.tilt(gravity_of(scene));
  simulation.drive(bodies_of(scene, simulation.world().grains));
  return simulation;
}

}  // namespace grseg
