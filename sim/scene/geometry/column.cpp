// SPDX-License-Identifier: GPL-3.0-or-later
// A column between the left wall and a gate, which is removed at t = 0.
#include "sim/scene/geometry.hpp"
#include "sim/scene/packing.hpp"

namespace grseg {
namespace {

void resolve_column(Scene& scene, const KeyGiven&)
{
  require(scene.lateral == Scene::Lateral::walls, "lateral",
          "lateral is periodic: a column needs walls; set lateral = walls");
  require(scene.column_width >= scene.large_diameter, "column-width",
          "column-width is below 1 d_L: a large grain does not fit in; choose a wider column");
  require(scene.column_width < scene.length, "column-width",
          "column-width is not below length: the column has no room to spread; enlarge length");
}

Boundaries column_boundaries(const Scene& scene)
{
  auto all = base_and_sides(scene);
  all.walls.push_back({{scene.column_width, 0, 0}, Vec3(-1, 0, 0)});  // the gate, the last wall
  return all;
}

Room room_of_column(const Scene& scene, double)
{
  return {0, scene.column_width};
}

void open_gate(Packing& packing, const Scene&)
{
  packing.walls.pop_back();
}

}  // namespace

const Geometry column_geometry{.name = "column",
                               .help = "its gate opens at t = 0",
                               .resolve = resolve_column,
                               .boundaries = column_boundaries,
                               .room_at = room_of_column,
                               .release = open_gate};

}  // namespace grseg
