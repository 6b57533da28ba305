// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/pair_list.hpp"

#include "tests/sim/worlds.hpp"

#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace grseg {
namespace {

using Named = std::set<std::pair<int, int>>;

/// Grains at rest in the form that the list needs, and their current positions.
struct Listed {
  GrainState<2> state;
  PairList<2> list;

  Listed(const World<2>& world, const std::vector<Vec2>& at, const std::vector<Wall<2>>& walls,
         double skin, double margin = 0)
      : state(make_state<2>(world.grains, at)),
        list(walls, world.box,
             *std::max_element(world.grains.radius.begin(), world.grains.radius.end()), skin,
             margin)
  {
  }

  void move_to(const std::vector<Vec2>& at)
  {
    for (std::size_t b = 0; b < state.size(); ++b)
      state.position[b] = at[static_cast<std::size_t>(state.row[b])];
  }
  bool complete(const std::vector<Vec2>& at)
  {
    move_to(at);
    return list.complete(state.position);
  }
  void renew(const std::vector<Vec2>& at)
  {
    move_to(at);
    list.renew(state, state.position);
  }

  struct Pair {
    int i, j;
    double shift, reach;
    std::size_t entry;
  };
  /// Pairs of the list; grains are named by their rows, and walls from -1 down.
  std::vector<Pair> pairs() const
  {
    std::vector<Pair> found;
    const auto& p = list.pairs();
    for (const auto& c : p.classes)
      for (std::size_t k = c.begin; k < c.end; ++k)
        if (p.listed(k))
          found.push_back({state.row[p.i[k] / 2], c.wall < 0 ? state.row[p.j[k] / 2] : -c.wall - 1,
                           p.geometry[k].shift, p.geometry[k].reach, k});
    return found;
  }
};

/// Discs of two sizes scattered over a strip; they cover 40 % of its area.
struct Scattered {
  World<2> world;
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

  /// Expects that the list contains all touching pairs, and that some pairs touch.
  void expect_all_pairs(const Listed& list) const
  {
    const auto expected = touching_by_brute_force();
    EXPECT_GT(expected.size(), 2u);
    EXPECT_EQ(touching_by(list), expected);
  }

 private:
  Named touching_by_brute_force() const
  {
    Named found;
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
  Named touching_by(const Listed& list) const
  {
    Named found;
    for (const auto& [i, j, shift, reach, entry] : list.pairs()) {
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
    Listed list(s.world, s.position, {}, 0.2);
    for (int step = 0; step < 200; ++step) {
      for (auto& x : s.position) {
        x.x() += 0.01 * x.y() + 0.04 * (gsl_rng_uniform(s.random) - 0.5);
        x.y() += 0.04 * (gsl_rng_uniform(s.random) - 0.5);
      }
      if (!list.complete(s.position)) list.renew(s.position);
      s.expect_all_pairs(list);
      ASSERT_FALSE(HasFailure()) << "step " << step;
    }
    EXPECT_LT(list.list.renewals(), 100u);
  }
}

TEST(PairList, HoldsEveryPairAtSizeRatioOneHundred)
{
  Scattered s(400, 300, true, 50);
  Listed list(s.world, s.position, {}, 0.2);
  list.renew(s.position);
  s.expect_all_pairs(list);
}

TEST(PairList, HoldsEveryPairInACellOfThreeDiameters)
{
  Scattered s(6.5, 60, true, 1);
  Listed list(s.world, s.position, {}, 0.2);
  list.renew(s.position);
  s.expect_all_pairs(list);
}

TEST(PairList, ABlockThatSlidesNeedsNoNewList)
{
  Scattered s(30, 20, true, 1);
  Listed list(s.world, s.position, {}, 0.2);
  list.renew(s.position);
  for (auto& x : s.position) x.x() += 12.3;
  EXPECT_TRUE(list.complete(s.position));
  s.position[5].x() += 0.3;
  EXPECT_FALSE(list.complete(s.position));
}

TEST(PairList, HoldsEveryPairWhenAGrainHasFlownFarAway)
{
  Scattered s(30, 20, true, 1);
  s.position[1].y() = 1e9;
  Listed list(s.world, s.position, {}, 0.2);
  list.renew(s.position);
  s.expect_all_pairs(list);
}

TEST(PairList, APairThatStaysKeepsItsImpulseThroughARenewal)
{
  World<2> world;
  for (const double x : {0.0, 1.0, 2.0}) worlds::add(world, {{x, 0}, 0.5});
  world.box = {100, 100, false};
  std::vector<Vec2> position{{0, 0}, {1, 0}, {2, 0}};
  Listed list(world, position, {}, 0.1);
  list.renew(position);
  ASSERT_EQ(list.pairs().size(), 2u);
  for (const auto& pair : list.pairs())
    list.list.pairs().memory[pair.entry] =
        pair.i == 0 ? PairMemory<2>{3, {-1}} : PairMemory<2>{4, {1}};
  position[2].x() = 5;  // the contact of the second pair ends
  list.renew(position);
  ASSERT_EQ(list.pairs().size(), 1u);
  const auto impulse = list.list.pairs().memory[list.pairs()[0].entry];
  EXPECT_EQ(impulse.n, 3);
  EXPECT_EQ(impulse.t[0], -1);
}

TEST(PairList, EveryPairOfABedKeepsItsOwnImpulseThroughARenewal)
{
  // Every pair of a full bed, also across the period and at a wall, keeps its own impulse.
  World<2> world;
  std::vector<Vec2> position;
  for (int row = 0; row < 12; ++row)
    for (int k = 0; k < 20; ++k) {
      position.push_back({0.4 + k, 0.6 + row});
      worlds::add(world, {position.back(), 0.5, row == 4});
    }
  world.box = {20, 100, true};
  Listed list(world, position, {worlds::floor_at(0)}, 0.2);
  list.renew(position);
  const auto own = [](const Listed::Pair& pair) {
    const double n = 1.0 + std::min(pair.i, pair.j) + 1000 * std::max(pair.i, pair.j);
    return PairMemory<2>{n, {1.0 + pair.i * pair.j}, -n};
  };
  const auto before = list.pairs();
  EXPECT_EQ(before.size(), 12u * 20 - 20 + 11 * 20 + 20);
  for (const auto& pair : before) list.list.pairs().memory[pair.entry] = own(pair);
  for (auto& x : position) x.x() += 7.7 - (x.x() + 7.7 >= 20 ? 20 : 0);
  list.renew(position);
  EXPECT_EQ(list.pairs().size(), before.size());
  for (const auto& pair : list.pairs()) {
    EXPECT_EQ(list.list.pairs().memory[pair.entry].n, own(pair).n) << pair.i << ' ' << pair.j;
    EXPECT_EQ(list.list.pairs().memory[pair.entry].t, own(pair).t);
    EXPECT_EQ(list.list.pairs().memory[pair.entry].approach, own(pair).approach);
  }
}

TEST(PairList, HoldsGrainsNearAWallAndNeedsANewListWhenAnotherComesNear)
{
  World<2> world;
  worlds::add(world, {{0, 0.55}, 0.5});
  worlds::add(world, {{5, 3}, 0.5});
  world.box = {100, 100, false};
  const std::vector<Wall<2>> walls{worlds::floor_at(0)};
  std::vector<Vec2> position{{0, 0.55}, {5, 3}};
  Listed list(world, position, walls, 0.1);
  list.renew(position);
  ASSERT_EQ(list.pairs().size(), 1u);
  EXPECT_EQ(list.pairs()[0].j, -1);
  position[1].y() = 0.5;
  EXPECT_FALSE(list.complete(position));
}

TEST(PairList, LayersThatSlideOverEachOtherNeedANewList)
{
  // d_max + skin = 1.2: y = 0 and y = 1.25 are in neighbouring bands, each of which moves as a whole.
  World<2> world;
  std::vector<Vec2> position;
  for (const double y : {0.0, 1.25})
    for (const double x : {0.0, 2.0, 4.0}) {
      position.push_back({x, y});
      worlds::add(world, {position.back(), 0.5});
    }
  world.box = {100, 100, false};
  Listed list(world, position, {}, 0.2);
  list.renew(position);
  for (int k = 3; k < 6; ++k) position[static_cast<std::size_t>(k)].x() += 0.19;
  EXPECT_TRUE(list.complete(position));
  for (int k = 3; k < 6; ++k) position[static_cast<std::size_t>(k)].x() += 0.02;
  EXPECT_FALSE(list.complete(position));
}

TEST(PairList, HoldsEveryPairOnceInACellOfTwoColumns)
{
  World<2> world;
  std::vector<Vec2> position{{1, 1}, {1.9, 1}, {3.4, 1}};
  for (const auto& x : position) worlds::add(world, {x, 0.5});
  worlds::add(world, {{4.4, 3}, 0.5});
  position.push_back({4.4, 3});
  world.box = {2.5, 10, true};  // two columns of d + skin = 1.2
  Listed list(world, position, {}, 0.2);
  list.renew(position);
  std::set<std::pair<int, int>> seen;
  for (const auto& pair : list.pairs())
    EXPECT_TRUE(seen.insert(std::minmax(pair.i, pair.j)).second);
  EXPECT_EQ(seen, (std::set<std::pair<int, int>>{{0, 1}, {0, 2}, {1, 2}}));
}

/// True if the list of two discs of diameter 1 with skin 0.2 is still complete after the second
/// disc has moved from `from` to `to`; the first one stays at (0, 0).
bool complete_after(const Vec2& from, const Vec2& to, double margin = 0)
{
  World<2> world;
  std::vector<Vec2> position{{0, 0}, from};
  for (const auto& x : position) worlds::add(world, {x, 0.5});
  world.box = {100, 100, false};
  Listed list(world, position, {}, 0.2, margin);
  list.renew(position);
  position[1] = to;
  return list.complete(position);
}

TEST(PairList, HoldsPairsWithinItsMargin)
{
  EXPECT_TRUE(complete_after({1.3, 0}, {1.22, 0}, 0.1));
  EXPECT_FALSE(complete_after({1.3, 0}, {1.18, 0}, 0.1));
}

TEST(PairList, GrainsOfDistantBandsNeedANewListWhenTheyCouldMeet)
{
  // Bands are 1.2 high: 4 is in the fourth band, and may be nearer by 1.2 + 0.2 without the list's
  // knowledge.
  EXPECT_TRUE(complete_after({0, 4}, {0, 2.7}));
  EXPECT_FALSE(complete_after({0, 4}, {0, 2.5}));
  EXPECT_TRUE(complete_after({0, 4}, {0, 50}));
}

TEST(PairList, GrainsOfDistantGroupsNeedANewListWhenTheyCouldMeet)
{
  EXPECT_TRUE(complete_after({40, 0}, {39, 0}));
  EXPECT_FALSE(complete_after({40, 0}, {1, 0}));
}

TEST(PairList, ALoneGrainThatFallsToAWallNeedsANewList)
{
  World<2> world;
  worlds::add(world, {{5, 3}, 0.5});
  world.box = {100, 100, false};
  std::vector<Vec2> position{{5, 3}};
  Listed list(world, position, {worlds::floor_at(0)}, 0.1);
  list.renew(position);
  position[0].y() = 4;
  EXPECT_TRUE(list.complete(position));
  position[0].y() = 0.5;
  EXPECT_FALSE(list.complete(position));
}

}  // namespace
}  // namespace grseg
