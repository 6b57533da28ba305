// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/pair_list.hpp"

#include "tests/sim/worlds.hpp"

#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace grseg {
namespace {

using Pairs = std::set<std::pair<int, int>>;

/// Discs of two sizes scattered over a strip, 40 % of its area.
struct Scattered {
  World world;
  std::vector<Vec2> position;
  gsl_rng* random = gsl_rng_alloc(gsl_rng_mt19937);

  Scattered(double length, double height, bool periodic, double largest)
  {
    const double mean_area = std::numbers::pi * (largest * largest + 0.25) / 2;
    const int count = static_cast<int>(0.4 * length * height / mean_area);
    for (int k = 0; k < count; ++k) {
      const Vec2 at{length * gsl_rng_uniform(random), height * gsl_rng_uniform(random)};
      worlds::add(world, {at, k % 2 == 0 ? largest : 0.5, k % 7 == 0});
      position.push_back(at);
    }
    world.box = {length, height, periodic};
  }
  ~Scattered() { gsl_rng_free(random); }

  Pairs touching_by_brute_force() const
  {
    Pairs found;
    const double length = world.box.length_x;
    for (std::size_t i = 0; i < position.size(); ++i) {
      for (std::size_t j = i + 1; j < position.size(); ++j) {
        if (world.grains.fixed[i] && world.grains.fixed[j]) continue;
        Vec2 apart = position[i] - position[j];
        if (world.box.periodic_x) apart.x() -= length * std::round(apart.x() / length);
        const double reach = world.grains.radius[i] + world.grains.radius[j];
        if (apart.norm() <= reach) found.insert({static_cast<int>(i), static_cast<int>(j)});
      }
    }
    return found;
  }
  Pairs touching_by(const PairList& list) const
  {
    Pairs found;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const auto [i, j, shift, reach] = list[k];
      EXPECT_FALSE(world.grains.fixed[static_cast<std::size_t>(i)]);
      Vec2 apart = position[static_cast<std::size_t>(i)] - position[static_cast<std::size_t>(j)];
      apart.x() += shift;
      EXPECT_EQ(reach, world.grains.radius[static_cast<std::size_t>(i)] +
                           world.grains.radius[static_cast<std::size_t>(j)]);
      if (apart.norm() <= reach) found.insert(std::minmax(i, j));
    }
    return found;
  }
};

TEST(PairList, HoldsEveryTouchingPairHoweverTheGrainsMove)
{
  for (const bool periodic : {true, false}) {
    Scattered s(30, 20, periodic, 1);
    PairList list(s.world.grains, {}, s.world.box, 0.2);
    for (int step = 0; step < 200; ++step) {
      for (auto& x : s.position) {
        x.x() += 0.01 * x.y() + 0.04 * (gsl_rng_uniform(s.random) - 0.5);
        x.y() += 0.04 * (gsl_rng_uniform(s.random) - 0.5);
      }
      if (!list.complete(s.position)) list.renew(s.world.grains, s.position);
      ASSERT_EQ(s.touching_by(list), s.touching_by_brute_force()) << "step " << step;
    }
    EXPECT_LT(list.renewals(), 100u);
  }
}

TEST(PairList, HoldsEveryPairAtSizeRatioOneHundred)
{
  Scattered s(400, 300, true, 50);
  PairList list(s.world.grains, {}, s.world.box, 0.2);
  list.renew(s.world.grains, s.position);
  EXPECT_EQ(s.touching_by(list), s.touching_by_brute_force());
}

TEST(PairList, HoldsEveryPairInACellOfThreeDiameters)
{
  Scattered s(6.5, 60, true, 1);
  PairList list(s.world.grains, {}, s.world.box, 0.2);
  list.renew(s.world.grains, s.position);
  EXPECT_EQ(s.touching_by(list), s.touching_by_brute_force());
}

TEST(PairList, ABlockThatSlidesRenewsNothing)
{
  Scattered s(30, 20, true, 1);
  PairList list(s.world.grains, {}, s.world.box, 0.2);
  list.renew(s.world.grains, s.position);
  for (auto& x : s.position) x.x() += 12.3;
  EXPECT_TRUE(list.complete(s.position));
  s.position[5].x() += 0.3;
  EXPECT_FALSE(list.complete(s.position));
}

TEST(PairList, FarFlyingGrainsCostNoMemory)
{
  Scattered s(30, 20, true, 1);
  s.position[1].y() = 1e9;
  PairList list(s.world.grains, {}, s.world.box, 0.2);
  list.renew(s.world.grains, s.position);
  EXPECT_EQ(s.touching_by(list), s.touching_by_brute_force());
}

TEST(PairList, ImpulsesOfPairsThatStaySurviveARenewal)
{
  World world;
  for (const double x : {0.0, 1.0, 2.0}) worlds::add(world, {{x, 0}, 0.5});
  world.box = {100, 100, false};
  std::vector<Vec2> position{{0, 0}, {1, 0}, {2, 0}};
  PairList list(world.grains, {}, world.box, 0.1);
  list.renew(world.grains, position);
  ASSERT_EQ(list.size(), 2u);
  list.impulse_n = {3, 4};
  list.impulse_t = {-1, 1};
  position[2].x() = 5;  // the second pair ends
  list.renew(world.grains, position);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list.impulse_n[0], 3);
  EXPECT_EQ(list.impulse_t[0], -1);
}

TEST(PairList, AWallIsMetByWhoeverComesNear)
{
  World world;
  worlds::add(world, {{0, 0.55}, 0.5});
  worlds::add(world, {{5, 3}, 0.5});
  world.box = {100, 100, false};
  const std::vector<Wall> walls{worlds::floor_at(0)};
  std::vector<Vec2> position{{0, 0.55}, {5, 3}};
  PairList list(world.grains, walls, world.box, 0.1);
  list.renew(world.grains, position);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].j, -1);
  position[1].y() = 0.5;
  EXPECT_FALSE(list.complete(position));
}

TEST(PairList, LayersInNeighbouringBandsThatSlideOverEachOtherRenewIt)
{
  // d_max + skin = 1.2: y = 0 and y = 1.25 lie in neighbouring bands, each of which moves as a
  // block.
  World world;
  std::vector<Vec2> position;
  for (const double y : {0.0, 1.25})
    for (const double x : {0.0, 2.0, 4.0}) {
      position.push_back({x, y});
      worlds::add(world, {position.back(), 0.5});
    }
  world.box = {100, 100, false};
  PairList list(world.grains, {}, world.box, 0.2);
  list.renew(world.grains, position);
  for (int k = 3; k < 6; ++k) position[static_cast<std::size_t>(k)].x() += 0.19;
  EXPECT_TRUE(list.complete(position));
  for (int k = 3; k < 6; ++k) position[static_cast<std::size_t>(k)].x() += 0.02;
  EXPECT_FALSE(list.complete(position));
}

TEST(PairList, NamesNoPairTwiceInACellOfTwoColumns)
{
  World world;
  std::vector<Vec2> position{{1, 1}, {1.9, 1}, {3.4, 1}};
  for (const auto& x : position) worlds::add(world, {x, 0.5});
  worlds::add(world, {{4.4, 3}, 0.5});
  position.push_back({4.4, 3});
  world.box = {2.5, 10, true};  // two columns of d + skin = 1.2
  PairList list(world.grains, {}, world.box, 0.2);
  list.renew(world.grains, position);
  std::set<std::pair<int, int>> seen;
  for (std::size_t k = 0; k < list.size(); ++k)
    EXPECT_TRUE(seen.insert({list[k].i, list[k].j}).second);
}

TEST(PairList, AGrainThatFallsAloneToAWallRenewsTheList)
{
  World world;
  worlds::add(world, {{5, 3}, 0.5});
  world.box = {100, 100, false};
  std::vector<Vec2> position{{5, 3}};
  PairList list(world.grains, {worlds::floor_at(0)}, world.box, 0.1);
  list.renew(world.grains, position);
  position[0].y() = 4;
  EXPECT_TRUE(list.complete(position));
  position[0].y() = 0.5;
  EXPECT_FALSE(list.complete(position));
}

}  // namespace
}  // namespace grseg
