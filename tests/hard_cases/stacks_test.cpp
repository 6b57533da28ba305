// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/solver.hpp"
#include "tests/hard_cases/case.hpp"
#include "tests/hard_cases/contact_problem.hpp"
#include "tests/hard_cases/heap_forces.hpp"
#include "tests/sim/contact_list.hpp"
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

/// Discs at rest on each other: distribution of the weight, and limits of equilibrium.
namespace grseg::hard_cases {
namespace {

using std::numbers::pi;
using worlds::Disc;
using worlds::positions_of;

constexpr double g = 9.8;

double mass_of(double radius)
{
  return pi * radius * radius;
}

TEST(Column, TheKthDiscCarriesTheWeightOfThoseAboveAndNothingMovesSideways)
{
  Case loads("H12", "force under the k-th disc over kmg"), sideways("H12", "sideways and spin");
  const int count = 20;
  std::vector<Disc> discs;
  for (int k = 0; k < count; ++k) discs.push_back({{0, 0.5 + k}, 0.5});
  auto world = worlds::world_of(discs);
  world.walls = {worlds::floor_at(0)};
  world.gravity = {0, -g};
  Simulation<2> column(world, positions_of(discs));
  Frame<2> frame;
  for (int step = 0; step < 100; ++step) {
    column.advance(frame);
    ASSERT_EQ(frame.contacts.size(), static_cast<std::size_t>(count));
    for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
      const int i = frame.contacts.i[c], j = frame.contacts.j[c];
      const double carried = count - std::max(i, j);
      loads.near(std::abs(frame.contacts.force[c].y()) / (carried * mass_of(0.5) * g), 1, 1e-8);
      sideways.near(frame.contacts.force[c].x(), 0, 0);
    }
    for (std::size_t k = 0; k < count; ++k) {
      sideways.near(column.position(k).x(), 0, 0);
      sideways.near(column.angular_velocity(k), 0, 0);
    }
  }
}

/// One disc on two that nearly touch, on a floor. If these touched, they could also push each other
/// by an undetermined force.
Simulation<2> pyramid(double friction)
{
  const double gap = 1e-6, x = (1 + gap) / 2;
  const std::vector<Disc> discs{
      {{-x, 0.5}, 0.5}, {{x, 0.5}, 0.5}, {{0, 0.5 + std::sqrt(1 - x * x)}, 0.5}};
  auto world = worlds::world_of(discs);
  world.walls = {worlds::floor_at(0)};
  world.material.friction = friction;
  world.gravity = {0, -g};
  return {world, positions_of(discs)};
}

TEST(Pyramid, OfThreeDiscsStandsIfFrictionIsAtLeastTheTangentOf15Degrees)
{
  // The torque on a lower disc is balanced if friction is equal above and below, so N sin 30 = T (1
  // + cos 30): T/N = tan 15. For the floor, which carries 3/2 N, tan 15/3 would suffice; all
  // contacts have one friction coefficient here, so the value for the discs is needed.
  Case normal("H17", "N over mg/2"), tangential("H17", "T over mg tan 15°/2"),
      below("H17", "force of the floor over 3mg/2"), still("H17", "speed after 2 s, μ = 0.28, m/s");
  const double weight = mass_of(0.5) * g;
  auto stands = pyramid(0.28);
  Frame<2> frame;
  for (int step = 0; step < 2000; ++step) stands.advance(frame);
  ASSERT_EQ(frame.contacts.size(), 4u);
  for (std::size_t c = 0; c < 4; ++c) {
    const Vec2 n = frame.contacts.branch[c].normalized(), f = frame.contacts.force[c];
    const double f_t = std::abs(f.dot(Vec2(-n.y(), n.x())));
    if (frame.contacts.j[c] < 0) {
      below.near(f.y() / (1.5 * weight), 1, 1e-5);
      continue;
    }
    normal.near(f.dot(n) / (weight / 2), 1, 1e-5);
    tangential.near(f_t / (weight / 2 * std::tan(pi / 12)), 1, 1e-5);
  }
  for (std::size_t d = 0; d < 3; ++d) still.at_most(stands.velocity(d).norm(), 1e-9);
}

TEST(Pyramid, OfThreeDiscsFallsIfFrictionIsLess)
{
  auto falls = pyramid(0.26);
  for (int step = 0; step < 4000; ++step) falls.advance();
  Case("H17", "the top disc has come down, μ = 0.26").holds(falls.position(2).y() < 0.9);
}

TEST(Groove, ADiscBetweenTwoWallsRestsAndItsForcesLieInTheInterval)
{
  // f_n (cos a + tau sin a) = mg/2 at each wall, where |tau| <= mu is the part of friction that is
  // used: the force is not unique, the velocity is.
  Case forces("H18", "f_n over mg/2 in its interval"), still("H18", "speed, m/s"),
      wedged("H18", "least f_n over f_n where friction can wedge the disc");
  for (const double degrees : {20.0, 45.0, 70.0})
    for (const double mu : {0.0, 0.2, 0.5}) {
      const double a = degrees * pi / 180, reach = 0.5 / std::cos(a);
      const std::vector<Disc> discs{{{0, reach}, 0.5}};
      auto world = worlds::world_of(discs);
      world.walls = {{{0, 0}, {std::sin(a), std::cos(a)}}, {{0, 0}, {-std::sin(a), std::cos(a)}}};
      world.material.friction = mu;
      world.gravity = {0, -g};
      Simulation<2> groove(world, positions_of(discs));
      Frame<2> frame;
      for (int step = 0; step < 200; ++step) groove.advance(frame);
      ASSERT_EQ(frame.contacts.size(), 2u);
      still.at_most(groove.velocity(0).norm(), 1e-9);
      for (std::size_t c = 0; c < 2; ++c) {
        const double f_n = frame.contacts.force[c].dot(frame.contacts.branch[c].normalized());
        const double least = std::cos(a) + mu * std::sin(a);
        const double most = std::cos(a) - mu * std::sin(a);  // <= 0: the force has no upper bound
        const double found = f_n / (mass_of(0.5) * g / 2);
        if (most > 0)
          forces.between(found, 1 / least - 1e-9, 1 / most + 1e-9);
        else
          wedged.at_most(1 / least / found, 1 + 1e-9);
      }
    }
}

TEST(Heap, ForcesDependOnTheOrderOfContactsAndVelocitiesDoNot)
{
  // A triangle of discs on touching fixed ones: it has many more contacts than its stability needs.
  // The range of each contact force that statics leaves open is known (heap_forces.hpp), and so is
  // the largest possible difference between two orders of contacts: 19.7 weights. A difference
  // counts if the spread is a thousand times the accuracy of the sums.
  std::vector<Disc> discs;
  const int base = 8;
  for (int row = 0; row < base; ++row)
    for (int k = 0; k < base - row; ++k)
      discs.push_back({{k + 0.5 * row, std::sqrt(0.75) * row}, 0.5, row == 0});
  auto world = worlds::world_of(discs);
  world.gravity = {0, -g};
  world.solver = {1e-10, 100000};
  Simulation<2> heap(world, positions_of(discs));
  Frame<2> frame;
  heap.advance(frame);
  const auto problem = contact_problem(heap, frame);
  const double gh = g * world.step;

  Case velocities("H19", "largest velocity in 20 orders of contacts, of gh"),
      sums("H19", "sum of forces on a disc, less its weight, of mg"),
      outside("H19", "a contact's force beyond what statics leaves open, mg"),
      spread("H19", "widest spread of a contact's force over 20 orders, mg (not unique)");
  std::mt19937 random(1);
  std::map<std::pair<int, int>, std::pair<double, double>> range;
  for (int order = 0; order < 20; ++order) {
    auto contacts = problem.contacts;
    auto motion = problem.motion;
    std::shuffle(contacts.begin(), contacts.end(), random);
    EXPECT_TRUE(solve_contacts(contacts, motion, 0.5, {}, {1e-10, 100000}, 1e-3 * gh).converged);
    std::vector<Vec2> sum(motion.size(), Vec2::Zero());
    for (const auto& c : contacts) {
      const Vec2 p = c.impulse_n * Vec2(c.n[0], c.n[1]) + c.impulse_t[0] * Vec2(-c.n[1], c.n[0]);
      sum[static_cast<std::size_t>(c.i)] += p;
      sum[static_cast<std::size_t>(c.j)] -= p;
      const double n = c.impulse_n / (mass_of(0.5) * gh);
      auto& [low, high] = range.try_emplace(std::minmax<int>(c.i, c.j), n, n).first->second;
      low = std::min(low, n);
      high = std::max(high, n);
    }
    for (std::size_t d = 0; d < discs.size(); ++d) {
      if (discs[d].fixed) continue;
      velocities.at_most(std::hypot(motion[d].v[0], motion[d].v[1], motion[d].rim[0]) / gh, 1e-6);
      sums.at_most((sum[d] / (mass_of(0.5) * gh) - Vec2(0, 1)).norm(), 1e-6);
    }
  }
  ASSERT_EQ(range.size(), std::size(heap_forces));
  double widest = 0, open = 0;
  for (const auto& [i, j, least, largest] : heap_forces) {
    const auto found = range.find({i, j});
    ASSERT_NE(found, range.end()) << i << " " << j;
    const auto [low, high] = found->second;
    outside.at_most(std::max({0.0, least - low, high - largest}), 1e-6);
    widest = std::max(widest, high - low);
    open = std::max(open, largest - least);
  }
  spread.between(widest, 1e-3, open);
}

}  // namespace
}  // namespace grseg::hard_cases
