// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/step/energies.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>

/// One disc on a plane: sliding, rolling, and the transition between them.
namespace grseg::hard_cases {
namespace {

constexpr double g = 9.8, r = 0.5, h = 1e-3;

/// A disc that touches a plane of slope angle `slope` (radians).
Simulation<2> on_a_plane(double slope, double friction, bool rotation)
{
  auto world = worlds::world_of({{{0, r}, r}});
  world.walls = {worlds::floor_at(0)};
  world.material.friction = friction;
  world.rotation = rotation;
  world.gravity = {g * std::sin(slope), -g * std::cos(slope)};
  return {world, {{0, r}}};
}

/// Velocity of the disc's lowest point.
double slip(const Simulation<2>& s)
{
  return s.velocity(0).x() + r * s.angular_velocity(0);
}

TEST(SlidingDisc, WithoutRotationStopsAfterVSquaredOverTwoMuG)
{
  // Each step removes mu g h of the speed until less is left. Friction acts over whole steps, so
  // only the last, incomplete step differs from the continuous motion: by at most mu g h^2/8.
  Case time("H9", "time v₀/(μg) to the stop, s"), way("H9", "way v₀²/(2μg) to the stop, m"),
      rest("H9", "speed afterwards, m/s");
  for (const double mu : {0.05, 0.5, 2.0})
    for (const double v : {0.3, 3.0}) {
      auto disc = on_a_plane(0, mu, false);
      disc.set_velocity(0, {v, 0});
      double stopped = 0;
      while (stopped == 0 && disc.time() < 100) {
        disc.advance();
        if (disc.velocity(0).x() < 1e-12) stopped = disc.time();
      }
      time.near(stopped, v / (mu * g), h);
      way.near(disc.position(0).x(), v * v / (2 * mu * g), mu * g * h * h / 8 * (1 + 1e-6));
      for (int k = 0; k < 1000; ++k) disc.advance();
      rest.near(disc.velocity(0).x(), 0, 1e-15);
    }
}

TEST(SlidingDisc, RollsAfterVOverThreeMuGAtTwoThirdsOfItsSpeed)
{
  Case time("H10", "time v₀/(3μg) until it rolls, s"), way("H10", "way 5v₀²/(18μg) until then, m"),
      speed("H10", "speed over 2v₀/3"), energy("H10", "part of the energy that is lost");
  for (const double mu : {0.05, 0.2, 1.0})
    for (const double v : {0.3, 3.0}) {
      auto disc = on_a_plane(0, mu, true);
      disc.set_velocity(0, {v, 0});
      const double before = translational_energy(disc) + rotational_energy(disc);
      while (slip(disc) > 1e-12 && disc.time() < 100) disc.advance();
      time.near(disc.time(), v / (3 * mu * g), h);
      const double late = disc.time() - v / (3 * mu * g);
      way.near(disc.position(0).x() - late * 2 * v / 3, 5 * v * v / (18 * mu * g),
               mu * g * h * h / 8 * (1 + 1e-6));
      for (int k = 0; k < 1000; ++k) disc.advance();
      speed.near(disc.velocity(0).x() / (2 * v / 3), 1, 1e-12);
      const double after = translational_energy(disc) + rotational_energy(disc);
      energy.near(1 - after / before, 1.0 / 3, 1e-12);
    }
}

TEST(DiscOnAnIncline, RollsIfTanIsAtMostThreeMuAndSlidesOtherwise)
{
  Case speed("H11", "speed after 1 s, m/s"), spin("H11", "rω after 1 s, m/s"),
      force("H11", "friction over mg"), way("H11", "way after 1 s, m");
  const double slope = 0.4, sine = std::sin(slope), cosine = std::cos(slope);
  for (const double part : {0.1, 0.9, 0.999, 1.001, 1.1, 5.0}) {  // friction over tan(slope)/3
    const double mu = part * std::tan(slope) / 3;
    auto disc = on_a_plane(slope, mu, true);
    Frame<2> frame;
    while (disc.time() < 1 - h / 2) disc.advance(frame);
    const bool rolls = part > 1;
    const double a = rolls ? 2.0 / 3 * g * sine : g * (sine - mu * cosine);
    speed.near(disc.velocity(0).x(), a, 1e-10);
    spin.near(-r * disc.angular_velocity(0), rolls ? a : 2 * mu * g * cosine, 1e-10);
    way.near(disc.position(0).x(), a / 2, 1e-10);
    force.near(-frame.contacts.force.at(0).x() / (disc.world().grains.mass[0] * g),
               rolls ? sine / 3 : mu * cosine, 1e-10);
  }
}

TEST(DiscOnAnIncline, WithoutRotationSlidesLikeABlock)
{
  Case speed("H11", "speed after 1 s without rotation, m/s");
  const double slope = 0.4;
  for (const double mu : {0.1, 0.4, 0.43, 2.0}) {  // tan = 0.423
    auto disc = on_a_plane(slope, mu, false);
    while (disc.time() < 1 - h / 2) disc.advance();
    const double a = std::max(0.0, g * (std::sin(slope) - mu * std::cos(slope)));
    speed.near(disc.velocity(0).x(), a, 1e-10);
    EXPECT_EQ(disc.angular_velocity(0), 0);
  }
}

}  // namespace
}  // namespace grseg::hard_cases
