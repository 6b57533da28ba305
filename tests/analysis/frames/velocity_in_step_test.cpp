// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/kinetic_stress.hpp"
#include "formats/core/errors.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

constexpr double h = 0.01, g = 9;

/// The frame with velocities in the middle of its step.
template <int D>
Frame<D> middle(const PackingOf<D>& packing, bool turning = true)
{
  auto frame = packing.frame;
  to_middle_of_step(packing.grains, h, turning, frame);
  return frame;
}

// The grain is released at t = 0: v = -g t at any time, and the step from t to t + h ends with -g (t + h).
TEST(VelocityInStep, AGrainThatFallsHasTheVelocityOfTheMiddleOfTheStep)
{
  for (const double t : {0.0, 0.37}) {
    Packing packing;
    packing.grain(Species::large, 0.2, {1, 5}, {3, -g * (t + h)}, 2);
    packing.frame.force = {{0, -g * packing.grains.mass[0]}};
    const auto frame = middle(packing);
    EXPECT_TRUE(same(frame.velocity[0], Vec2(3, -g * (t + h / 2))));
    EXPECT_EQ(frame.angular_velocity[0], 2);
  }
}

// Velocity -u before the step and e u after it: -(1 - e) u/2 on average.
TEST(VelocityInStep, AGrainThatBouncesHasTheMeanOfBeforeAndAfter)
{
  constexpr double u = 4;
  for (const double e : {0.0, 0.5, 1.0}) {
    Packing packing;
    packing.grain(Species::small, 0.1, {1, 0.1}, {0, e * u});
    const double force = packing.grains.mass[0] * (1 + e) * u / h;  // net, includes weight
    packing.frame.force = {{0, force}};
    packing.wall_contact(0, 0, {0, force + packing.grains.mass[0] * g}, {0, 0.1});
    EXPECT_TRUE(same(middle(packing).velocity[0], Vec2(0, -(1 - e) * u / 2), 1e-14));
  }
}

// A disc that meets the floor with the rim velocity u_t = v_t + r w and sticks loses u_t/3 of v_t
// and 2 u_t/3 of r w; a sphere loses 2 u_t/7 and 5 u_t/7. In the middle of the step, half is lost.
TEST(VelocityInStep, AGrainThatSticksHasLostHalfOfTheSpinThatItLoses)
{
  constexpr double r = 0.1, v_t = 3, w = 10, u_t = v_t + r * w;
  Packing disc;
  disc.grain(Species::small, r, {1, r}, {v_t - u_t / 3, 0}, w - 2 * u_t / (3 * r));
  disc.frame.force = {{-disc.grains.mass[0] * u_t / 3 / h, 0}};
  disc.wall_contact(0, 0, disc.frame.force[0] + Vec2(0, 50), {0, r});
  EXPECT_TRUE(same(middle(disc).velocity[0], Vec2(v_t - u_t / 6, 0)));
  EXPECT_NEAR(middle(disc).angular_velocity[0], w - u_t / (3 * r), 1e-13);
  // If grains do not rotate, spins are not changed.
  EXPECT_EQ(middle(disc, false).angular_velocity[0], disc.frame.angular_velocity[0]);

  // On the floor y = 0, the velocity of a sphere's lowest point is v_x + r w_z and v_z - r w_x.
  PackingOf<3> sphere;
  const double w_z = w - 5 * u_t / (7 * r), w_x = -w_z;
  sphere.grain(Species::small, r, {1, r, 1}, {v_t - 2 * u_t / 7, 0, v_t - 2 * u_t / 7},
               {w_x, 6, w_z});
  const double pull = -sphere.grains.mass[0] * 2 * u_t / 7 / h;
  sphere.frame.force = {{pull, 0, pull}};
  sphere.wall_contact(0, 0, Vec3(pull, 50, pull), {0, r, 0});
  const auto frame = middle(sphere);
  EXPECT_TRUE(same(frame.velocity[0], Vec3(v_t - u_t / 7, 0, v_t - u_t / 7)));
  const double half = w - 5 * u_t / (14 * r);
  EXPECT_TRUE(same(frame.angular_velocity[0], Vec3(-half, 6, half), 1e-13));
}

// Two discs that rub change their spins with the same sign, each by its own radius over its own
// moment of inertia.
TEST(VelocityInStep, BothGrainsOfAContactAreTurnedByIt)
{
  Packing pair;
  pair.grain(Species::large, 0.2, {1, 1}, {0, 0}, 1);
  pair.grain(Species::small, 0.1, {1.3, 1}, {0, 0}, 1);
  const double push = 0.01;
  pair.contact(0, 1, {0, push});
  pair.frame.force = {{0, push}, {0, -push}};
  const auto frame = middle(pair);
  for (const std::size_t grain : {0u, 1u}) {
    const double radius = pair.grains.radius[grain], mass = pair.grains.mass[grain];
    // The upward force on the left grain acts at its right end: counter-clockwise, like the
    // downward force at the left end of the right grain. The spins before were smaller.
    const double gained = h * radius * push / (mass * radius * radius / 2);
    EXPECT_NEAR(frame.angular_velocity[grain], 1 - gained / 2, 1e-13);
  }
}

TEST(VelocityInStep, WhatForcesDoNotMoveKeepsItsVelocity)
{
  Packing packing;
  packing.grain(Species::boundary, 0.1, {1, 0}, {5, 0}, 3);
  packing.frame.force = {{1, 1}};
  const auto frame = middle(packing);
  EXPECT_EQ(frame.velocity[0], Vec2(5, 0));
  EXPECT_EQ(frame.angular_velocity[0], 3);
}

TEST(VelocityInStep, IsNotKnownWithoutTheForcesOfTheGrains)
{
  Packing packing;
  packing.grain(Species::small, 0.1, {1, 1}, {0, 0});
  EXPECT_THROW(middle(packing), FormatError);
}

}  // namespace
}  // namespace grseg
