// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/hard_cases/case.hpp"
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// One contact that closes among more than a thousand that have long been at rest.
namespace grseg::hard_cases {
namespace {

constexpr double tolerance = 1e-2;

/// A bed of 60 layers of discs of diameter 1 on a row of fixed ones, periodic, that has come to
/// rest under a disc of diameter 4, the last grain, held just above it.
Simulation settled_bed()
{
  const int layers = 60, width = 12;
  const double pitch = 1.02, rise = std::sqrt(1 - pitch * pitch / 4);
  std::vector<worlds::Disc> discs;
  for (int row = 0; row <= layers; ++row)
    for (int k = 0; k < width; ++k)
      discs.push_back({{pitch * (k + 0.5 * (row % 2)), rise * row}, 0.5, row == 0});
  discs.push_back({{pitch * width / 2 + 1e-3, rise * layers + 0.5 + 2 + 0.05}, 2});
  auto world = worlds::world_of(discs);
  world.box = {pitch * width, 100, true};
  world.gravity = {0, -9.8};
  world.solver = {tolerance, 5000};
  Simulation bed(world, worlds::positions_of(discs));
  for (int step = 0; step < 300; ++step) {
    bed.set_velocity(discs.size() - 1, {0, 0});
    bed.advance();
  }
  return bed;
}

/// How deep the last grain overlaps others when they first meet, and at most, m.
struct Landing {
  double first = 0, deepest = 0;

  Landing(Simulation bed, double speed)
  {
    const std::size_t last = bed.world().grains.size() - 1;
    bed.set_velocity(last, {0, -speed});
    bool landed = false;
    Frame frame;
    for (int step = 0; step < 60; ++step) {
      EXPECT_TRUE(bed.advance(frame).solver.converged);
      const auto& list = frame.contacts;
      for (std::size_t c = 0; c < list.size(); ++c) {
        if (std::max(list.i[c], list.j[c]) != static_cast<std::int32_t>(last)) continue;
        if (!landed) first = -list.gap[c];
        landed = true;
        deepest = std::max(deepest, -list.gap[c]);
      }
    }
    EXPECT_TRUE(landed);
  }
};

TEST(Newcomer, ADiscThatLandsOnASettledBedIsStoppedWithinTheTolerance)
{
  // Its overlap is what it moved when it was first seen; after that step it sinks by no more than
  // the tolerance times its way per step: by half of that, or, were the sweeps to stop at the
  // quadratic mean of the changes, by 5.6 times that.
  const auto bed = settled_bed();
  const double step = bed.world().step;
  Case sinking("H40", "sinking after the step of first touch, of the way per step"),
      deepest("H40", "overlap of the newcomer, of d_S");
  for (const double speed : {4.9, 5.0, 5.1, 5.2}) {
    const Landing landing(bed, speed);
    deepest.at_most(landing.deepest, tolerance);
    sinking.at_most((landing.deepest - landing.first) / (speed * step), tolerance);
  }
}

}  // namespace
}  // namespace grseg::hard_cases
