// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/sweep.hpp"
#include "tests/hard_cases/flows.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

/// The same run in other units, on other instruction sets.
namespace grseg::hard_cases {
namespace {

/// The same crowd with all lengths times `length` and all masses times `mass`, under the same
/// gravity, so that times go with the square root of lengths.
Crowd scaled(Crowd c, double length, double mass)
{
  const double time = std::sqrt(length);
  for (auto& r : c.world.grains.radius) r *= length;
  for (auto& m : c.world.grains.mass) m *= mass;
  for (auto& wall : c.world.walls) wall.point *= length;
  c.world.box.length_x *= length;
  c.world.box.length_y *= length;
  c.world.step *= time;
  for (auto& x : c.position) x *= length;
  for (auto& v : c.velocity) v *= length / time;
  for (auto& w : c.spin) w /= time;
  return c;
}

TEST(Units, LengthsAThousandthAndMassesAMillionTimesGiveTheSameFlow)
{
  const auto original = flow(6, 6, 0.5);
  const double length = 1e-3, mass = 1e6, speed = std::sqrt(length);
  auto a = original.simulation(), b = scaled(original, length, mass).simulation();
  Frame in_a, in_b;
  for (int step = 0; step < 1000; ++step) {
    a.advance(in_a);
    b.advance(in_b);
  }
  for (std::size_t g = 0; g < original.position.size(); ++g) {
    EXPECT_NEAR((b.position(g) / length - a.position(g)).norm(), 0, 1e-10);
    EXPECT_NEAR((b.velocity(g) / speed - a.velocity(g)).norm(), 0, 1e-10);
  }
  EXPECT_GT(in_a.contacts.size(), 30u);
  ASSERT_EQ(in_a.contacts.i, in_b.contacts.i);
  ASSERT_EQ(in_a.contacts.j, in_b.contacts.j);
  const double weight = 9.8 * original.world.grains.mass[0];
  for (std::size_t c = 0; c < in_a.contacts.size(); ++c)
    EXPECT_NEAR((in_b.contacts.force[c] / mass - in_a.contacts.force[c]).norm() / weight, 0, 1e-9);
}

/// All that the last frame of a flow says, as bits.
std::vector<std::uint64_t> bits_of_a_flow()
{
  auto c = flow(8, 8, 0.5);
  c.world.material.restitution = 0.25;
  auto simulation = c.simulation();
  Frame frame;
  for (int step = 0; step < 1000; ++step) simulation.advance(frame);
  std::vector<std::uint64_t> bits;
  const auto add = [&](double x) { bits.push_back(std::bit_cast<std::uint64_t>(x)); };
  for (const auto* vectors : {&frame.position, &frame.velocity, &frame.contacts.force})
    for (const auto& v : *vectors) {
      add(v.x());
      add(v.y());
    }
  for (const double w : frame.angular_velocity) add(w);
  return bits;
}

TEST(InstructionSets, AFlowIsTheSameToTheLastBitOnEachAndEachTime)
{
  const auto best = bits_of_a_flow();
  EXPECT_GT(best.size(), 64u * 5 + 2 * 30);
  EXPECT_EQ(best, bits_of_a_flow());
  for (const auto& set : instruction_sets()) {
    use_instruction_set(set);
    EXPECT_EQ(best, bits_of_a_flow()) << set;
  }
  use_instruction_set("");
}

}  // namespace
}  // namespace grseg::hard_cases
