// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/mean_velocity.hpp"
#include "analysis/stress/kinetic_stress.hpp"
#include "tests/analysis/grain_builder.hpp"
#include "tests/analysis/stress/kinetic_of_frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace grseg {
namespace {

using std::numbers::pi;

const Layers unit_layers(1, 10);
constexpr double bin = 0.5;

/// Grains of two masses at random heights below 3, in a shear flow, with independent fluctuations.
struct Shear {
  static constexpr double shear = 3, light_variance = 1, heavy_variance = 0.4;
  static constexpr double light_radius = 0.1, heavy_radius = 0.2;

  static Packing drawn(std::mt19937& random, int grains)
  {
    std::uniform_real_distribution<double> height(0, 3);
    std::normal_distribution<double> kick(0, 1);
    Packing packing;
    for (int g = 0; g < grains; ++g) {
      const bool heavy = g % 4 == 0;
      const double y = height(random), root = std::sqrt(heavy ? heavy_variance : light_variance);
      packing.grain(heavy ? Species::large : Species::small, heavy ? heavy_radius : light_radius,
                    {0.1, y}, {2 + shear * y + root * kick(random), root * kick(random)},
                    root * kick(random));
    }
    return packing;
  }
};

KineticStress<2> kinetic(const std::vector<Packing>& frames, MeanFlow flow)
{
  return kinetic_of(frames, flow, bin);
}

TEST(UnbiasedProfile, TheMeanOfOthersIsTheProfileThatWasMadeWithoutTheGrain)
{
  std::mt19937 random(3);
  const auto all = Shear::drawn(random, 60);
  MeanVelocity<2> mean(unit_layers, bin);
  mean.add(all.grains, all.frame);
  mean.finish();
  for (std::size_t g = 0; g < all.grains.size(); ++g) {
    auto others = all;
    others.grains.species[g] = Species::boundary;
    others.grains.fixed[g] = 1;
    MeanVelocity<2> without(unit_layers, bin);
    without.add(others.grains, others.frame);
    without.finish();
    const double y = all.frame.position[g].y();
    const auto found =
        mean.on_profile_of_others(y, all.grains.mass[g], motion_of<2>(unit_layers, all.frame, g));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->mean.isApprox(without.on_profile(y), 1e-11)) << g;
  }
}

// A window of two frames has about 13 grains in a bin. The mean of N windows is accurate to four of
// its standard errors; the fluctuation about the whole profile is too small by more than that.
TEST(UnbiasedProfile, GrainsOfTwoMassesHaveTheVarianceTheyWereDrawnWithInWindowsOfTwoFrames)
{
  constexpr int windows = 4000, grains = 40;
  std::mt19937 random(1);
  struct Mean {
    double sum = 0, squares = 0;
    void add(double x) { sum += x, squares += x * x; }
    double value() const { return sum / windows; }
    double error() const { return std::sqrt((squares / windows - value() * value()) / windows); }
  };
  Mean temperature[2][2][3];  // [unbiased][species][x, y, spin]
  for (int w = 0; w < windows; ++w) {
    const std::vector<Packing> frames{Shear::drawn(random, grains), Shear::drawn(random, grains)};
    int which = 0;
    for (const auto flow : {MeanFlow::profile, MeanFlow::profile_unbiased}) {
      const auto stress = kinetic(frames, flow);
      for (const auto species : {Species::small, Species::large}) {
        KineticStress<2>::Mean all;
        for (std::size_t layer = 0; layer < stress.layers(); ++layer)
          all += stress.mean(layer, species);
        EXPECT_EQ(all.left_out, 0);
        for (int k = 0; k < 3; ++k)
          temperature[which][static_cast<int>(species)][k].add(all.temperature()[k]);
      }
      ++which;
    }
  }
  for (const auto species : {Species::small, Species::large}) {
    const bool heavy = species == Species::large;
    const double truth = heavy ? Shear::heavy_variance : Shear::light_variance;
    for (int k = 0; k < 3; ++k) {
      const auto& biased = temperature[0][static_cast<int>(species)][k];
      const auto& unbiased = temperature[1][static_cast<int>(species)][k];
      const double spin =
          k == 2 ? 0.5 * std::pow(heavy ? Shear::heavy_radius : Shear::light_radius, 2) : 1;
      EXPECT_NEAR(unbiased.value(), spin * truth, 4 * unbiased.error()) << heavy << k;
      if (heavy) {
        EXPECT_LT(biased.value(), spin * truth - 10 * biased.error()) << k;
      }
    }
  }
}

// n equal grains at one height in one frame: their profile is their mean V, and sum (v - V)^2 is
// too small by the factor 1 - 1/n.
TEST(UnbiasedProfile, OfEqualGrainsInOneBinTheFactorIsThatOfTheSampleVariance)
{
  Packing packing;
  std::mt19937 random(2);
  std::normal_distribution<double> kick(0, 1);
  constexpr int n = 5;
  for (int g = 0; g < n; ++g)
    packing.grain(Species::small, 0.1, {0.1, 0.25}, {kick(random), kick(random)}, kick(random));
  const auto unbiased = kinetic({packing}, MeanFlow::profile_unbiased).mean(0, Species::small),
             plain = kinetic({packing}, MeanFlow::profile).mean(0, Species::small);
  EXPECT_TRUE(
      unbiased.about_mean.kinetic.isApprox(n / (n - 1.0) * plain.about_mean.kinetic, 1e-12));
  EXPECT_NEAR(unbiased.about_mean.rotational, n / (n - 1.0) * plain.about_mean.rotational, 1e-14);
  EXPECT_DOUBLE_EQ(plain.own_part / plain.mass, 1.0 / n);
}

TEST(UnbiasedProfile, AGrainWithoutTwoOthersInItsBinIsComparedWithTheNearestBinsThatHaveThem)
{
  Packing packing;
  for (const double x : {1, 2, 4}) {
    packing.grain(Species::small, 0.1, {x, 0.25}, {x, 0});
    packing.grain(Species::small, 0.1, {x, 2.25}, {x + 8, 0});
  }
  packing.grain(Species::large, 0.1, {1, 1.25}, {9, 0});
  const auto large = kinetic({packing}, MeanFlow::profile_unbiased).mean(1, Species::large);
  EXPECT_EQ(large.left_out, 0);
  // About 7/3 + 4. The variance of the mean of 1, 2 and 4 is 14/3, the sum of squares about the mean,
  // over 6; the mean of two such means has half of that.
  const double excess = 9 - (7.0 / 3 + 4);
  EXPECT_NEAR(large.about_mean.kinetic(0, 0), pi * 0.01 * (excess * excess - 7.0 / 18), 1e-14);
}

TEST(UnbiasedProfile, WhereNoBinHasThreeGrainsNoneCounts)
{
  Packing packing;
  packing.grain(Species::small, 0.1, {1, 0.25}, {5, 0});
  packing.grain(Species::large, 0.1, {2, 0.25}, {7, 0});
  const auto stress = kinetic({packing}, MeanFlow::profile_unbiased);
  EXPECT_EQ(stress.mean(0, Species::small).left_out, 1);
  EXPECT_EQ(stress.mean(0, Species::large).left_out, 1);
  EXPECT_EQ(stress.mean(0, Species::large).grains, 0);
}

}  // namespace
}  // namespace grseg
