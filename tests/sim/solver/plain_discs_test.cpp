// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/sim/solver/plain_discs.hpp"

#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace grseg {
namespace {

using worlds::Disc;

/// Rows of discs of two sizes above a row of fixed ones, in a cell periodic along x, under gravity
/// that is tilted by 25 degrees.
std::vector<Disc> bed(int columns, int rows)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.05, 0.05);
  std::vector<Disc> discs;
  for (int k = 0; k < columns; ++k) discs.push_back({{k + 0.5, 0}, 0.5, true});
  for (int row = 1; row <= rows; ++row)
    for (int k = 0; k < columns; ++k)
      discs.push_back(
          {{k + 0.5 + shift(random), 1.05 * row + shift(random)}, (k + row) % 3 == 0 ? 0.3 : 0.45});
  return discs;
}

struct Both {
  World<2> world;
  Simulation<2> fast;
  plain::Discs slow;

  Both(const std::vector<Disc>& discs, double length, const Material& material, ContactLaw law)
      : world(world_with(discs, length, material, law)), fast(world, worlds::positions_of(discs))
  {
    slow.gravity = world.gravity;
    slow.step = world.step;
    slow.period = length;
    slow.material = material;
    slow.law = world.law;
    slow.law.margin = std::max(slow.law.margin, least_margin * 0.6);
    for (std::size_t g = 0; g < discs.size(); ++g)
      slow.disc.push_back({.radius = world.grains.radius[g],
                           .mass = world.grains.mass[g],
                           .fixed = world.grains.fixed[g] != 0});
  }
  static World<2> world_with(const std::vector<Disc>& discs, double length,
                             const Material& material, ContactLaw law)
  {
    auto world = worlds::world_of(discs);
    world.box = {length, 100, true};
    world.gravity = {std::sin(0.436), -std::cos(0.436)};
    world.step = 5e-3;
    world.material = material;
    world.law = law_parameters(law, 0.75, world.step, 1, 0.6);
    world.solver = {1e-14, 200000};
    return world;
  }

  /// Takes a step from the same positions, velocities and impulses; returns the largest difference
  /// of a velocity or rim velocity after it.
  double step()
  {
    for (std::size_t g = 0; g < slow.disc.size(); ++g) {
      slow.disc[g].x = fast.position(g);
      slow.disc[g].v = fast.velocity(g);
      slow.disc[g].spin = fast.angular_velocity(g);
    }
    slow.remember(memory());
    const auto report = fast.advance();
    EXPECT_FALSE(report.solved_again);
    EXPECT_EQ(report.parts, 1);
    slow.advance();
    double difference = 0;
    for (std::size_t g = 0; g < slow.disc.size(); ++g) {
      const auto& disc = slow.disc[g];
      difference = std::max({difference, (disc.v - fast.velocity(g)).norm(),
                             disc.radius * std::abs(disc.spin - fast.angular_velocity(g))});
    }
    return difference;
  }
  /// The impulses that the simulator remembers, by grains.
  std::map<std::pair<std::size_t, std::size_t>, plain::Contact> memory() const
  {
    const auto state = fast.state();
    const auto grain = [&](std::uint32_t place) {
      const auto body = place / position_doubles<2>;
      return body < state.row.size() ? static_cast<std::size_t>(state.row[body]) : SIZE_MAX;
    };
    std::map<std::pair<std::size_t, std::size_t>, plain::Contact> all;
    const auto& pairs = state.pairs;
    for (std::size_t k = 0; k < pairs.i.size(); ++k) {
      auto& c = all[std::minmax(grain(pairs.i[k]), grain(pairs.j[k]))];
      c.impulse_n = pairs.impulse_n[k];
      c.impulse_t = pairs.impulse_t[k][0];
      c.approach = pairs.approach.empty() ? 0 : pairs.approach[k];
    }
    return all;
  }
};

// Grains rain on a bed and flow down it: impacts, sliding, chains of contacts. With Coulomb friction
// impulses need not be unique, but from one first guess both solvers reach one solution.
TEST(PlainDiscs, MoveInEachStepAsTheSimulatorMovesThem)
{
  for (const auto law : {ContactLaw::speculative, ContactLaw::centred})
    for (const Material material : {Material{0.5, 0.25}, {0, 0.5}, {0.3, 0}}) {
      Both both(bed(8, 6), 8, material, law);
      std::size_t most_contacts = 0;
      for (int step = 0; step < 600; ++step) {
        ASSERT_LT(both.step(), 1e-10) << "step " << step;
        most_contacts = std::max(most_contacts, both.slow.contacts().size());
      }
      EXPECT_GT(most_contacts, 40u);
    }
}

}  // namespace
}  // namespace grseg
