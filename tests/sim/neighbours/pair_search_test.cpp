// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/neighbours/pair_list.hpp"
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace grseg {
namespace {

using Named = std::set<std::pair<std::int32_t, std::int32_t>>;

/// Grains of two radii, scattered at random over a box.
template <int D>
struct Cloud {
  static constexpr double small = 0.5, skin = 0.7 * 2 * small;
  Grains grains;
  std::vector<Vector<D>> position;
  Box box;

  Cloud(const Box& in, double large, int count) : box(in)
  {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int k = 0; k < count; ++k) {
      grains.id.push_back(k);
      grains.species.push_back(k % 5 == 0 ? Species::large : Species::small);
      grains.radius.push_back(k % 5 == 0 ? large : small);
      grains.mass.push_back(1);
      grains.fixed.push_back(false);
      Vector<D> at;
      at.x() = box.length_x * uniform(random);
      at.y() = box.length_y * uniform(random);
      if constexpr (D == 3) at.z() = box.length_z * uniform(random);
      position.push_back(at);
    }
  }

  double gap(std::size_t i, std::size_t j) const
  {
    Vector<D> apart = position[i] - position[j];
    const auto nearest = [](double& along, double period) {
      along -= period * std::round(along / period);
    };
    if (box.periodic_x) nearest(apart.x(), box.length_x);
    if constexpr (D == 3)
      if (box.periodic_z) nearest(apart.z(), box.length_z);
    return apart.norm() - grains.radius[i] - grains.radius[j];
  }
  Named pairs_within(double most) const
  {
    Named pairs;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(position.size()); ++i)
      for (std::int32_t j = 0; j < i; ++j)
        if (gap(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) <= most)
          pairs.insert({j, i});
    return pairs;
  }

  void expect_exactly_the_pairs_within_the_skin() const
  {
    auto state = make_state<D>(grains, position);
    const double largest = *std::max_element(grains.radius.begin(), grains.radius.end());
    PairSearch<D> search({}, box, 2 * largest + skin, skin, 1);
    search.find(state, state.position);
    Named all, near;
    for (std::uint32_t a = 0; a < state.size(); ++a)
      for (auto f = search.found.begin[a]; f < search.found.begin[a + 1]; ++f) {
        const auto pair = std::minmax(state.row[a], state.row[search.found.b[f]]);
        EXPECT_TRUE(all.insert(pair).second) << "twice";
        if (f < search.found.far[a]) near.insert(pair);
      }
    EXPECT_EQ(all, pairs_within(skin));
    EXPECT_EQ(near, pairs_within(near_part<D> * skin));
    EXPECT_GT(all.size(), 2 * position.size());
  }
};

// Boxes from one to many cells wide; a cell is 2.7 wide where large grains have radius 1.
TEST(PairSearch, ListsExactlyThePairsOfDiscsWhoseGapIsAtMostTheSkin)
{
  for (const bool periodic : {true, false})
    for (const double length : {5.0, 9.0, 11.0, 40.0})
      for (const double large : {0.6, 1.0, 2.5})
        Cloud<2>({length, 20, periodic}, large, static_cast<int>(20 * length))
            .expect_exactly_the_pairs_within_the_skin();
}

TEST(PairSearch, ListsExactlyThePairsOfSpheresWhoseGapIsAtMostTheSkin)
{
  for (const bool x : {true, false})
    for (const bool z : {true, false})
      for (const double length : {6.0, 9.0, 20.0})
        for (const double width : {6.0, 8.5, 12.0})
          for (const double large : {0.6, 1.0}) {
            Box box{length, 10, x, 3, width, z};
            Cloud<3>(box, large, static_cast<int>(4 * length * width))
                .expect_exactly_the_pairs_within_the_skin();
          }
}

TEST(PairSearch, ListsExactlyThePairsAcrossTheBordersOfStrips)
{
  Cloud<3>({60, 9, true, 3, 10, true}, 1, 11000).expect_exactly_the_pairs_within_the_skin();
  Cloud<2>({400, 30, true}, 1, 11000).expect_exactly_the_pairs_within_the_skin();
}

/// Force on the first of two touching spheres, from the memory of their pair; its entry.
std::pair<std::array<double, 3>, std::size_t> force_on_first(const PairList<3>& list,
                                                             const GrainState<3>& state)
{
  const auto& pairs = list.pairs();
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (pairs.listed(k)) {
      auto t = pairs.memory[k].t;
      if (state.row[pairs.i[k] / position_doubles<3>] != 0)
        for (auto& component : t) component = -component;
      return {t, k};
    }
  return {{}, pairs.size()};
}

TEST(PairSearch, FrictionStaysTheSameForceWhenSpheresChangePlacesAlongTheCells)
{
  Cloud<3> cloud({20, 20, false, 3, 20, false}, 0.5, 4);
  cloud.position = {{5, 5, 5}, {6, 5, 5}, {0, 0, 0}, {19, 5, 19}};  // two touch, two span the grid
  auto state = make_state<3>(cloud.grains, cloud.position);
  PairList<3> list({}, cloud.box, 0.5, 0.2, 0);
  list.renew(state, state.position);
  const std::array<double, 3> friction{0, 3, -4};
  auto [none, entry] = force_on_first(list, state);
  const bool first_is_i = state.row[list.pairs().i[entry] / position_doubles<3>] == 0;
  auto stored = friction;
  if (!first_is_i)
    for (auto& component : stored) component = -component;
  list.pairs().set_memory(entry, 10, stored, 0);
  int exchanges = 0;
  for (int turn = 1; turn <= 8; ++turn) {
    const double angle = turn * std::acos(-1.0) / 4;
    for (std::size_t b = 0; b < state.size(); ++b) {
      if (state.row[b] > 1) continue;
      const double side = state.row[b] == 0 ? -0.5 : 0.5;
      state.position[b].head<3>() =
          Vec3(5.5 + side * std::cos(angle), 5, 5 + side * std::sin(angle));
    }
    list.renew(state, state.position);
    const auto [force, now] = force_on_first(list, state);
    EXPECT_EQ(force, friction) << turn;
    exchanges += (state.row[list.pairs().i[now] / position_doubles<3>] == 0) != first_is_i ? 1 : 0;
  }
  EXPECT_GT(exchanges, 0);
}

}  // namespace
}  // namespace grseg
