// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// One contact that closes among hundreds that have long been at rest.
namespace grseg::hard_cases {
namespace {

using worlds::Disc;

/// A bed of 60 layers of discs of diameter 1 on a row of fixed ones, periodic, and a disc of
/// diameter 4 above it: the last grain.
struct Bed {
  static constexpr int layers = 60, width = 6;
  std::vector<Disc> discs;

  Bed()
  {
    const double pitch = 1.02, rise = std::sqrt(1 - pitch * pitch / 4);
    for (int row = 0; row <= layers; ++row)
      for (int k = 0; k < width; ++k)
        discs.push_back({{pitch * (k + 0.5 * (row % 2)), rise * row}, 0.5, row == 0});
    discs.push_back({{pitch * 3 + 1e-3, rise * layers + 0.5 + 2 + 0.05}, 2});
  }

  World world(double tolerance) const
  {
    auto world = worlds::world_of(discs);
    world.box = {1.02 * width, 100, true};
    world.gravity = {0, -9.8};
    world.solver = {tolerance, 5000};
    return world;
  }
};

TEST(Newcomer, ADiscThatLandsOnASettledBedSinksInByNoMoreThanTheTolerance)
{
  // What its way per step explains is 0.005 of the bed's discs; the rest is the solver's.
  const double tolerance = 1e-2, speed = 5;
  const Bed bed;
  Simulation simulation(bed.world(tolerance), worlds::positions_of(bed.discs));
  const auto newcomer = static_cast<std::int32_t>(bed.discs.size() - 1);
  for (int step = 0; step < 400; ++step) {
    simulation.set_velocity(bed.discs.size() - 1, {0, 0});
    simulation.advance();
  }
  simulation.set_velocity(bed.discs.size() - 1, {0, -speed});
  double overlap = -1;
  Frame frame;
  for (int step = 0; step < 200; ++step) {
    EXPECT_TRUE(simulation.advance(frame).solver.converged);
    const auto& list = frame.contacts;
    for (std::size_t c = 0; c < list.size(); ++c)
      if (list.i[c] == newcomer || list.j[c] == newcomer) overlap = std::max(overlap, -list.gap[c]);
  }
  EXPECT_GT(overlap, 0);
  EXPECT_LE(overlap, tolerance);
}

}  // namespace
}  // namespace grseg::hard_cases
