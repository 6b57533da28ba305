// SPDX-License-Identifier: GPL-3.0-or-later
// A bed on its base, which may be shaken.
#include "sim/scene/geometry.hpp"
#include "sim/scene/packing.hpp"

#include <numbers>

namespace grseg {
namespace {

class Bed : public Geometry {
 public:
  using Geometry::Geometry;

  void resolve(Scene&, const KeyGiven&) const override {}

  bool can_shake(const Scene& scene) const override { return scene.base == Scene::Base::grains; }

  bool can_shape_base(const Scene& scene) const override
  {
    return scene.base == Scene::Base::grains;
  }

  Boundaries boundaries(const Scene& scene) const override
  {
    Boundaries all;
    add_base(all, scene);
    add_side_walls(all, scene);
    return all;
  }

  std::vector<BoundaryBody> bodies(const Scene& scene, const Grains& grains) const override
  {
    if (scene.shake_amplitude == 0) return {};
    auto base = body_of_beads(grains);
    base.amplitude = {0, scene.shake_amplitude};
    base.angular_frequency = 2 * std::numbers::pi * scene.shake_frequency;
    return {base};
  }
};

}  // namespace

const Geometry& bed_geometry()
{
  static const Bed bed("bed", "on its base");
  return bed;
}

}  // namespace grseg
