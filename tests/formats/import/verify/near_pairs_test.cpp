// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/frame_tools.hpp"
#include "formats/import/verify/unlisted_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace grseg {
namespace {

struct Crowd {
  Grains grains;
  Box box;
  Frame<3> frame;
};

/// Grains with radii from 0.01 to 0.5 in a cell of length 3, some absent, some boundary grains.
Crowd crowd(int dimension)
{
  const bool in_space = dimension == 3;
  Crowd crowd{{}, {3, 3, true, dimension, in_space ? 3.0 : 0.0, in_space}, {}};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 3), size(std::log(0.01), std::log(0.5));
  for (int g = 0; g < 300; ++g) {
    crowd.grains.id.push_back(g);
    crowd.grains.radius.push_back(std::exp(size(random)));
    crowd.grains.mass.push_back(1);
    crowd.grains.fixed.push_back(g % 7 == 0);
    crowd.grains.species.push_back(g % 7 == 0 ? Species::boundary : Species::small);
    Vec3 x = Vec3::Zero();
    for (int axis = 0; axis < dimension; ++axis) x[axis] = place(random);
    if (g % 11 == 0) x.setConstant(NAN);
    crowd.frame.position.push_back(x);
  }
  return crowd;
}

void expect_all_pairs(int dimension)
{
  const auto [grains, box, frame] = crowd(dimension);
  std::vector<std::pair<int, int>> expected, found;
  for (std::size_t i = 0; i < grains.size(); ++i)
    for (std::size_t j = i + 1; j < grains.size(); ++j) {
      if (i % 11 == 0 || j % 11 == 0 || (i % 7 == 0 && j % 7 == 0)) continue;
      const auto between = minimum_image(box, frame.position[i] - frame.position[j]);
      const double smaller = std::min(grains.radius[i], grains.radius[j]);
      if (between.norm() <= grains.radius[i] + grains.radius[j] + 0.1 * smaller)
        expected.emplace_back(i, j);
    }
  for (const auto& pair : near_pairs(grains, box, frame, 0.1, [](const NearPair&) { return true; }))
    found.emplace_back(pair.i, pair.j);
  EXPECT_GT(expected.size(), 100u);
  EXPECT_EQ(found, expected);
}

TEST(NearPairs, AreThoseOfAllPairsInAPlane)
{
  expect_all_pairs(2);
}

TEST(NearPairs, AreThoseOfAllPairsInSpace)
{
  expect_all_pairs(3);
}

}  // namespace
}  // namespace grseg
