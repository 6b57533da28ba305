// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/hard_cases/case.hpp"
#include "tests/hard_cases/contact_problem.hpp"
#include "tests/sim/contact_list.hpp"
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// One contact that closes among more than a thousand contacts that have been at rest for long.
namespace grseg::hard_cases {
namespace {

constexpr double tolerance = 1e-2;

/// A periodic bed of 60 layers of discs of diameter 1 on a row of fixed discs, at rest. A disc of
/// diameter 4, the last grain, is held just above it.
Simulation<2> settled_bed()
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
  Simulation<2> bed(world, worlds::positions_of(discs));
  for (int step = 0; step < 300; ++step) {
    bed.set_velocity(discs.size() - 1, {0, 0});
    bed.advance();
  }
  return bed;
}

/// Largest change that relaxing a single contact would still make after a step, over the reference
/// velocity of the tolerance (solver.hpp), computed from the frame.
double change_left(const Simulation<2>& bed, const Frame<2>& frame)
{
  auto problem = contact_problem(bed, frame);
  for (std::size_t k = 0; k < bed.world().grains.size(); ++k) {
    auto& m = problem.motion[k];
    m.v[0] = frame.velocity[k].x();
    m.v[1] = frame.velocity[k].y();
    m.rim[0] = frame.angular_velocity[k] * bed.world().grains.radius[k];
  }
  double squares = 0;
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    auto& contact = problem.contacts[c];
    const Vec2 n(contact.n[0], contact.n[1]), t(-contact.n[1], contact.n[0]);
    const Vec2 impulse = frame.contacts.force[c] * bed.world().step;
    contact.impulse_n = impulse.dot(n);
    contact.impulse_t[0] = impulse.dot(t);
    squares += std::pow(contact.impulse_n / contact.mass_n, 2) +
               std::pow(contact.impulse_t[0] / contact.mass_t, 2);
  }
  const double reference = std::sqrt(squares / static_cast<double>(problem.contacts.size()));
  return contact_residual(problem.contacts, problem.motion, bed.world().material.friction, {}) /
         reference;
}

/// Overlap of the last grain with others when they first meet, and its maximum, m; and the largest
/// change that relaxing any contact after a step would make.
struct Landing {
  double first = 0, deepest = 0, change = 0;

  Landing(Simulation<2> bed, double speed)
  {
    const std::size_t last = bed.world().grains.size() - 1;
    bed.set_velocity(last, {0, -speed});
    bool landed = false;
    Frame<2> frame;
    for (int step = 0; step < 60; ++step) {
      EXPECT_TRUE(bed.advance(frame).solver.converged);
      change = std::max(change, change_left(bed, frame));
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
  // The disc's overlap is its way in the step in which it was first detected; afterwards it sinks
  // by at most the tolerance times its way per step. A contact is exact when it has just been
  // relaxed. Then others change its discs by the tolerance each, of which either disc gets half:
  // five other contacts on each disc leave 5 tolerances. If sweeps stopped by the quadratic mean of
  // the changes, a single one of the 2200 could be as large as 47.
  const auto bed = settled_bed();
  const double step = bed.world().step;
  Case sinking("H40", "sinking after the step of first touch, of the way per step"),
      deepest("H40", "overlap of the newcomer, of d_S"),
      change("H40", "violation of the contact law that a step leaves, of 5 tolerances");
  for (const double speed : {4.9, 5.0, 5.1, 5.2}) {
    const Landing landing(bed, speed);
    deepest.at_most(landing.deepest, tolerance);
    sinking.at_most((landing.deepest - landing.first) / (speed * step), tolerance);
    change.at_most(landing.change / (5 * tolerance), 1);
  }
}

}  // namespace
}  // namespace grseg::hard_cases
