// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/energies.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/hard_cases/flows.hpp"
#include "tests/hard_cases/recorded.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

/// Grains of very different sizes.
namespace grseg::hard_cases {
namespace {

/// Two large discs fly into a loose bed of small ones of diameter 1/ratio.
Crowd large_and_small(double ratio)
{
  const double d = 1 / ratio;
  const int columns = 60, rows = 20;
  Crowd c = crowd(1, 1, 0);
  std::vector<worlds::Disc> discs;
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < columns; ++k)
      discs.push_back({{d * (1.1 * k + 0.3 * (row % 2)), d * (1.1 * row + 0.6)}, d / 2});
  const double length = std::max(1.1 * columns * d, 2.5);
  const double top = d * (1.1 * rows + 0.6);
  discs.push_back({{0.25 * length, top + 0.52}, 0.5});
  discs.push_back({{0.75 * length, top + 0.55}, 0.5});
  c.world = worlds::world_of(discs);
  c.world.box = {length, 100, true};
  c.world.walls = {worlds::floor_at(0)};
  c.world.gravity = {0, -9.8};
  c.world.step = 0.01 * std::sqrt(d / 9.8);
  c.world.solver = {1e-2, 100};
  c.position = worlds::positions_of(discs);
  c.velocity.assign(discs.size(), {0.1, -1});
  c.spin.assign(discs.size(), 0);
  return c;
}

/// Pairs that touch, found by checking all pairs.
std::set<std::pair<int, int>> touching(const World<2>& world, const Frame<2>& frame, double margin)
{
  std::set<std::pair<int, int>> pairs;
  const int count = static_cast<int>(frame.position.size());
  for (int a = 0; a < count; ++a) {
    const auto i = static_cast<std::size_t>(a);
    if (frame.position[i].y() - world.grains.radius[i] <= margin) pairs.insert({a, -1});
    for (int b = a + 1; b < count; ++b) {
      const auto j = static_cast<std::size_t>(b);
      Vec2 apart = frame.position[i] - frame.position[j];
      apart.x() -= world.box.length_x * std::round(apart.x() / world.box.length_x);
      if (apart.norm() - world.grains.radius[i] - world.grains.radius[j] <= margin)
        pairs.insert({a, b});
    }
  }
  return pairs;
}

TEST(SizeRatio, OfTenAndAHundredLosesNoPair)
{
  Case missed("H36", "pairs of a brute-force search that are missing, ratios 10 and 100"),
      invented("H36", "contacts that a brute-force search does not find");
  for (const double ratio : {10.0, 100.0}) {
    const auto c = large_and_small(ratio);
    auto simulation = c.simulation();
    Frame<2> frame;
    std::size_t most = 0;
    for (int step = 0; step < 200; ++step) {
      simulation.advance(frame);
      if (step % 25 != 0) continue;
      const double margin = simulation.world().law.margin;
      std::set<std::pair<int, int>> listed;
      for (std::size_t k = 0; k < frame.contacts.size(); ++k)
        listed.insert({frame.contacts.i[k], frame.contacts.j[k]});
      const auto lacks = [](const auto& set, const auto& other) {
        return static_cast<double>(std::count_if(other.begin(), other.end(),
                                                 [&](const auto& p) { return set.count(p) == 0; }));
      };
      missed.at_most(lacks(listed, touching(simulation.world(), frame, margin - 1e-12)), 0);
      invented.at_most(lacks(touching(simulation.world(), frame, margin + 1e-12), listed), 0);
      most = std::max(most, listed.size());
    }
    EXPECT_GT(most, 100u);
  }
}

TEST(SizeRatio, OfAHundredLandsWithEveryStepInBalance)
{
  // The large discs are 10^4 times as heavy as the discs on which they fall.
  Case defects("G3", "energy defect of a step, size ratio 100"),
      momenta("G3", "impulse of the floor less that of weight and change of momentum, relative"),
      lowest("G3", "overlap with the floor over the radius, 1 where a centre is below it");
  const auto c = large_and_small(100);
  auto simulation = c.simulation();
  const auto& grains = c.world.grains;
  double mass = 0;
  const auto momentum = [&] {
    Vec2 sum = Vec2::Zero();
    for (std::size_t k = 0; k < grains.size(); ++k) sum += grains.mass[k] * simulation.velocity(k);
    return sum;
  };
  for (const double m : grains.mass) mass += m;
  const Vec2 start = momentum();
  Vec2 floor = Vec2::Zero();
  Frame<2> frame;
  const int steps = 1500;
  for (int step = 0; step < steps; ++step) {
    floor += simulation.advance(frame).base_impulse.head<2>();
    const auto balance = energy_balance<2>(grains, frame, simulation.before(), c.world.gravity,
                                           simulation.written_step());
    defects.at_most(balance.defect(), 1e-12);
  }
  const Vec2 weight = steps * c.world.step * mass * c.world.gravity;
  momenta.at_most((floor + weight - momentum() + start).norm() / weight.norm(), 1e-12);
  for (std::size_t k = 0; k < grains.size(); ++k)
    lowest.at_most(std::max(0.0, 1 - simulation.position(k).y() / grains.radius[k]), 1);

  // They land at 0.03 d_S per step, and may overlap by as much.
  Case("G3", "a run in which they land goes on")
      .holds(words_of_a_run(c.simulation(), 0.01, steps, 10).empty());
}

}  // namespace
}  // namespace grseg::hard_cases
