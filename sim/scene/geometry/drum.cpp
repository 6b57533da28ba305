// SPDX-License-Identifier: GPL-3.0-or-later
// A ring of beads that turns.
#include "sim/scene/geometry.hpp"
#include "sim/scene/packing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grseg {
namespace {

/// The axis, m: y = 0 is the lowest point of the drum.
Vec2 centre_of(const Scene& scene)
{
  return {scene.length / 2, scene.drum_diameter / 2};
}

class Drum : public Geometry {
 public:
  using Geometry::Geometry;

  void resolve(Scene& scene, const KeyGiven&) const override
  {
    require(scene.lateral == Scene::Lateral::walls, "lateral",
            "lateral is periodic: a drum is closed; set lateral = walls");
    require(scene.drum_diameter >= 4 * scene.large_diameter, "drum-diameter",
            "drum-diameter is below 4 d_L: large grains have no room to flow; choose a wider one");
    scene.length = scene.drum_diameter + 2 * scene.large_diameter;
    scene.depth = scene.fill * scene.drum_diameter;
  }

  Boundaries boundaries(const Scene& scene) const override
  {
    Boundaries all;
    const double radius = bead_radius(scene), ring = scene.drum_diameter / 2 + radius;
    const long beads = std::lround(std::floor(std::numbers::pi / std::asin(radius / ring)));
    for (long k = 0; k < beads; ++k) {
      const double angle =
          2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(beads);
      add_bead(all, scene, centre_of(scene) + ring * Vec2(std::sin(angle), -std::cos(angle)));
    }
    return all;
  }

  Room room_at(const Scene& scene, double y) const override
  {
    const double radius = scene.drum_diameter / 2, away = y - radius;
    const double half = std::sqrt(std::max(0.0, radius * radius - away * away));
    return {centre_of(scene).x() - half, centre_of(scene).x() + half};
  }

  double bed_area(const Scene& scene) const override
  {
    return scene.fill * std::numbers::pi / 4 * scene.drum_diameter * scene.drum_diameter;
  }

  bool checks_height() const override { return false; }

  std::vector<BoundaryBody> bodies(const Scene& scene, const Grains& grains) const override
  {
    auto drum = body_of_beads(grains);
    drum.centre = centre_of(scene);
    drum.spin = scene.drum_rate;
    return {drum};
  }

  void describe(const Scene& scene, Parameters& parameters) const override
  {
    const auto centre = centre_of(scene);
    parameters.numbers["drum_centre"] = {centre.x(), centre.y()};
    parameters.numbers["drum_diameter"] = {scene.drum_diameter};
  }
};

}  // namespace

const Geometry& drum_geometry()
{
  static const Drum drum("drum", "turning");
  return drum;
}

}  // namespace grseg
