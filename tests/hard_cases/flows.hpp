// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/sim/worlds.hpp"

#include <gsl/gsl_rng.h>

#include <memory>

/// Small random crowds of discs of two sizes.
namespace grseg::hard_cases {

struct Crowd {
  World<2> world;
  std::vector<Vec2> position;
  std::vector<Vec2> velocity;
  std::vector<double> spin;  // rad/s

  Simulation<2> simulation() const
  {
    Simulation<2> s(world, position);
    for (std::size_t g = 0; g < velocity.size(); ++g) s.set_velocity(g, velocity[g], spin[g]);
    return s;
  }
};

/// `columns` times `rows` discs that do not touch, with random velocities of up to `speed`, above y
/// = 0 in a cell that is periodic in x.
inline Crowd crowd(int columns, int rows, double speed)
{
  const std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> random{gsl_rng_alloc(gsl_rng_mt19937),
                                                                 gsl_rng_free};
  const auto symmetric = [&](double most) {
    return most * (2 * gsl_rng_uniform(random.get()) - 1);
  };
  std::vector<worlds::Disc> discs;
  Crowd c;
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < columns; ++k) {
      const Vec2 site{1.2 * k + 0.6, 1.2 * row + 0.8};
      discs.push_back({site + Vec2(symmetric(0.05), symmetric(0.05)),
                       (row + k) % 3 == 0 ? 0.5 : 0.35 + symmetric(0.1)});
      c.velocity.emplace_back(symmetric(speed), symmetric(speed));
      c.spin.push_back(symmetric(speed));
    }
  c.world = worlds::world_of(discs);
  c.world.box = {1.2 * columns, 1000, true};
  c.world.solver = {1e-2, 500};
  c.position = worlds::positions_of(discs);
  return c;
}

/// The same discs; they fall on a floor and flow down a slope whose tangent is `slope`.
inline Crowd flow(int columns, int rows, double slope)
{
  auto c = crowd(columns, rows, 1);
  c.world.walls = {worlds::floor_at(0)};
  c.world.gravity = 9.8 * Vec2(slope, -1).normalized();
  return c;
}

}  // namespace grseg::hard_cases
