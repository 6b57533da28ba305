// SPDX-License-Identifier: GPL-3.0-or-later
// A column between the left wall and a gate, which is gone at t = 0.
#include "sim/scene/geometry.hpp"
#include "sim/scene/packing.hpp"

namespace grseg {
namespace {

class Column : public Geometry {
 public:
  using Geometry::Geometry;

  void resolve(Scene& scene, const KeyGiven&) const override
  {
    require(scene.lateral == Scene::Lateral::walls, "lateral",
            "lateral is periodic: a column stands between walls; set lateral = walls");
    require(scene.column_width >= scene.large_diameter, "column-width",
            "column-width is below 1 d_L: a large grain does not fit in; choose a wider one");
    require(scene.column_width < scene.length, "column-width",
            "column-width is not below length: the column needs room to fall into");
  }

  Boundaries boundaries(const Scene& scene) const override
  {
    Boundaries all;
    add_base(all, scene);
    add_side_walls(all, scene);
    all.walls.push_back({{scene.column_width, 0}, {-1, 0}});  // the gate
    return all;
  }

  Room room_at(const Scene& scene, double) const override { return {0, scene.column_width}; }

  Simulation release(const Simulation& deposited, const Scene&) const override
  {
    auto packing = packing_of(deposited);
    packing.world.walls.pop_back();
    return set_in_motion(packing, deposited);
  }
};

}  // namespace

const Geometry& column_geometry()
{
  static const Column column("column", "its gate opens at t = 0");
  return column;
}

}  // namespace grseg
