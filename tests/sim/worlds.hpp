// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/step/simulation.hpp"

#include <numbers>
#include <vector>

/// Small worlds for tests: discs of density 1 in a wide open box, with or without a floor.
namespace grseg::worlds {

struct Disc {
  Vec2 position;
  double radius;
  bool fixed = false;
};

inline void add(World<2>& world, const Disc& disc)
{
  auto& g = world.grains;
  g.id.push_back(static_cast<std::int32_t>(g.size()));
  g.species.push_back(disc.fixed ? Species::boundary : Species::small);
  g.radius.push_back(disc.radius);
  g.mass.push_back(std::numbers::pi * disc.radius * disc.radius);
  g.fixed.push_back(disc.fixed);
}

/// World of discs without gravity, friction 0.5 and restitution 0, solved to 1e-12.
inline World<2> world_of(const std::vector<Disc>& discs)
{
  World<2> world;
  for (const auto& disc : discs) add(world, disc);
  world.box = {1000, 1000, false};
  world.material = {0.5, 0};
  world.step = 1e-3;
  world.solver = {1e-12, 100000};
  return world;
}

inline std::vector<Vec2> positions_of(const std::vector<Disc>& discs)
{
  std::vector<Vec2> positions;
  for (const auto& disc : discs) positions.push_back(disc.position);
  return positions;
}

inline Wall<2> floor_at(double y)
{
  return {{0, y}, {0, 1}};
}

}  // namespace grseg::worlds
