// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/flux.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace grseg {
namespace {

const Layers layers(1, 10);

/// Grains of radius 0.01 in 20 layers of 50; `large(layer)`: number of large grains in a layer.
template <class Large>
Packing bed(const Large& large)
{
  Packing scene;
  for (int layer = 0; layer < 20; ++layer)
    for (int g = 0; g < 50; ++g)
      scene.grain(g < large(layer) ? Species::large : Species::small, 0.01, {0.1 * g, layer + 0.5},
                  {0, 0});
  return scene;
}

double index_of(const Packing& scene)
{
  return mixing_index(layers, scene.grains, scene.frame);
}

TEST(MixingIndex, IsZeroForSeparatedSpecies)
{
  EXPECT_NEAR(index_of(bed([](int layer) { return layer < 8 ? 50 : 0; })), 0, 1e-12);
}

// s^2 = 0, s_r^2 = phi_L phi_S/50 for equal grains: s_0^2/(s_0^2 - s_r^2) = 50/49.
TEST(MixingIndex, IsLargerForARegularMixtureThanForARandomOne)
{
  EXPECT_NEAR(index_of(bed([](int) { return 20; })), 50.0 / 49, 1e-12);
}

// Mean over 200 beds. If grains are drawn with replacement, the variance is phi_L phi_S/50, except
// for the bed's own share of 1/20; Stange's formula extends this to unequal sizes.
TEST(MixingIndex, IsOneForARandomMixture)
{
  std::mt19937 random(2);
  std::bernoulli_distribution is_large(0.1);
  double mean = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Packing scene;
    for (int layer = 0; layer < 20; ++layer)
      for (int g = 0; g < 200; ++g) {
        const bool large = is_large(random);
        scene.grain(large ? Species::large : Species::small, large ? 0.02 : 0.01,
                    {0.1 * g, layer + 0.5}, {0, 0});
      }
    mean += (1 - index_of(scene)) / 200;
  }
  // 1 - index = (s^2 - s_r^2)/(s_0^2 - s_r^2). phi_L = 4/13, area 1.3 per grain: s_r^2/s_0^2 =
  // (9/13 * 4 + 4/13)/(200 * 1.3) = 0.0118. The bed's own share is a twentieth of it.
  EXPECT_NEAR(mean, 0, 0.1 * 0.0118);
}

TEST(MixingIndex, IsUnknownForASingleSpecies)
{
  EXPECT_TRUE(std::isnan(index_of(bed([](int) { return 0; }))));
}

}  // namespace
}  // namespace grseg
