// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/kinetic_stress.hpp"

#include "tests/analysis/grain_builder.hpp"
#include "tests/analysis/stress/kinetic_of_frames.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace grseg {
namespace {

using std::numbers::pi;

const Layers unit_layers(1, 10);
constexpr double bin = 0.125;
constexpr std::array all_means{MeanFlow::profile, MeanFlow::layer, MeanFlow::instant,
                               MeanFlow::instant_unbiased, MeanFlow::species};

KineticStress<2> kinetic(const std::vector<Packing>& frames, MeanFlow flow)
{
  return kinetic_of(frames, flow, bin);
}

/// 300 grains at random heights up to 3; velocity and spin are functions of height alone.
template <class Velocity>
Packing column(const Velocity& velocity, double noise = 0)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> height(0, 3);
  std::normal_distribution<double> kick(0, 1);
  Packing packing;
  for (int g = 0; g < 300; ++g) {
    const double y = height(random);
    const Vec2 extra{noise * kick(random), noise * kick(random)};
    packing.grain(g % 3 == 0 ? Species::large : Species::small, g % 3 == 0 ? 0.04 : 0.02,
                  {0.01 * g, y}, velocity(y) + extra, -0.5 * velocity(y).x());
  }
  return packing;
}

double largest(const KineticStress<2>& stress)
{
  double most = 0;
  for (std::size_t n = 0; n < stress.layers(); ++n)
    for (const auto species : {Species::small, Species::large}) {
      const auto mean = stress.mean(n, species);
      most = std::max(
          {most, mean.about_mean.kinetic.cwiseAbs().maxCoeff(), mean.about_mean.rotational});
    }
  return most;
}

// This is true for any positions of grains in their bins.
TEST(KineticStress, ALinearShearHasNoFluctuationsAboutItsProfile)
{
  const Packing shear = column([](double y) { return Vec2{5 + 2 * y, 0.1 - 0.3 * y}; });
  EXPECT_LT(largest(kinetic({shear}, MeanFlow::profile)), 1e-28);
  EXPECT_GT(largest(kinetic({shear}, MeanFlow::layer)), 1e-3);
}

// The drum turns clockwise at Omega r; described as motion over a base, all of it is fluctuation.
TEST(KineticStress, ADrumThatTurnsAsAWholeHasNoFluctuationsInAnnuli)
{
  const Vec2 axis{3, 2};
  const double rate = 1.5;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1, 1);
  Packing packing;
  for (int g = 0; g < 300; ++g) {
    const Vec2 arm{2 * place(random), 2 * place(random)};
    packing.grain(g % 3 == 0 ? Species::large : Species::small, 0.02, axis + arm,
                  rate * Vec2(arm.y(), -arm.x()), -rate);
  }
  const auto annuli = Layers::annuli(0.5, 10, axis);
  MeanVelocity<2> mean(annuli, bin);
  mean.add(packing.grains, packing.frame);
  KineticStress<2> stress(annuli, MeanFlow::profile, mean);
  stress.add(packing.grains, packing.frame);
  EXPECT_LT(largest(stress), 1e-26);
  EXPECT_NEAR(stress.flow(2).du_dy, rate, 1e-12);
  EXPECT_NEAR(stress.flow(2).v, 0, 1e-14);
  EXPECT_GT(largest(kinetic({packing}, MeanFlow::profile)), 1e-3);
}

TEST(KineticStress, APlugHasNoFluctuationsAboutAnyMean)
{
  const Packing plug = column([](double) { return Vec2{3, -1}; });
  for (const auto flow : all_means) EXPECT_LT(largest(kinetic({plug}, flow)), 1e-28);
}

// N equal grains at equal distances over the thickness h: sum m (du)^2 = M (du/dy h)^2 (1 -
// 1/N^2)/12, i.e. the bias nu rho (du/dy h)^2/12 of a mean over the layer.
TEST(KineticStress, TheLayerMeanLeavesTheShearInside)
{
  constexpr int count = 40;
  constexpr double shear = 3, radius = 0.01;
  Packing packing;
  for (int k = 0; k < count; ++k) {
    const double y = (k + 0.5) / count;
    packing.grain(Species::small, radius, {0.1 * k, y}, {shear * y, 0});
  }
  const double mass = count * pi * radius * radius;
  const auto stress = kinetic({packing}, MeanFlow::layer);
  const auto mean = stress.mean(0, Species::small);
  EXPECT_NEAR(mean.about_mean.kinetic(0, 0),
              mass * shear * shear * (1 - 1.0 / (count * count)) / 12, 1e-15);
  EXPECT_NEAR(mean.about_mean.kinetic(1, 1), 0, 1e-28);
  EXPECT_NEAR(stress.flow(0).du_dy, shear, 1e-10);
  EXPECT_NEAR(stress.flow(0).u, shear / 2, 1e-12);
}

TEST(KineticStress, TwoGrainsThatPartCarryTheirFluctuations)
{
  Packing packing;
  packing.grain(Species::small, 0.1, {1, 0.5}, {2 + 0.3, 0.4}, 7);
  packing.grain(Species::small, 0.1, {2, 0.5}, {2 - 0.3, -0.4}, 3);
  const double mass = pi * 0.01;
  for (const auto flow : all_means) {
    if (flow == MeanFlow::instant_unbiased) continue;  // it needs three grains
    const auto stress = kinetic({packing}, flow);
    const auto mean = stress.mean(0, Species::small);
    Tensor2 expected;
    expected << 0.09, 0.12, 0.12, 0.16;
    EXPECT_TRUE(same(mean.about_mean.kinetic, 2 * mass * expected));
    EXPECT_NEAR(mean.about_mean.rotational, 2 * mass * 0.01 / 2 * 4, 1e-15);
    EXPECT_NEAR(mean.mass, 2 * mass, 1e-15);
    EXPECT_TRUE(std::isnan(stress.flow(0).du_dy));
  }
}

TEST(KineticStress, SpeciesThatSlideThroughEachOtherAreQuietAboutTheirOwnMeans)
{
  Packing packing;
  packing.grain(Species::large, 0.2, {1, 0.5}, {1, 0});
  packing.grain(Species::small, 0.1, {2, 0.5}, {6, 0});
  const double mass = pi * 0.01;  // mass of the small grain; the large one has four times that
  EXPECT_LT(largest(kinetic({packing}, MeanFlow::species)), 1e-28);
  for (const auto flow : {MeanFlow::profile, MeanFlow::layer}) {
    const auto stress = kinetic({packing}, flow);  // about the mass-weighted mean, u = 2
    EXPECT_NEAR(stress.flow(0).u, 2, 1e-14);
    EXPECT_NEAR(stress.mean(0, Species::small).about_mean.kinetic(0, 0), mass * 16, 1e-14);
    EXPECT_NEAR(stress.mean(0, Species::large).about_mean.kinetic(0, 0), 4 * mass, 1e-14);
  }
}

TEST(KineticStress, TheMeanIsThatOfTheWindowNotOfTheInstant)
{
  const Packing forth = column([](double) { return Vec2{1, 0}; });
  const Packing back = column([](double) { return Vec2{-1, 0}; });
  const auto stress = kinetic({forth, back}, MeanFlow::profile);
  for (std::size_t n = 0; n < 3; ++n) {
    const auto mean = stress.mean(n, Species::large);
    EXPECT_NEAR(mean.about_mean.kinetic(0, 0), mean.mass, 1e-14);
  }
}

TEST(KineticStress, AnObserverWhoMovesAlongSeesTheSameFluctuations)
{
  const auto flow_at = [](double y) { return Vec2{y * (6 - y), 0}; };
  const Packing packing = column(flow_at, 0.3);
  Packing seen = packing;
  for (auto& velocity : seen.frame.velocity) velocity += Vec2{40, -7};
  for (const auto flow : all_means) {
    const auto here = kinetic({packing}, flow), there = kinetic({seen}, flow);
    for (std::size_t n = 0; n < 3; ++n) {
      EXPECT_TRUE(same(here.mean(n, Species::small).about_mean.kinetic,
                       there.mean(n, Species::small).about_mean.kinetic, 1e-13));
      EXPECT_NEAR(there.flow(n).u, here.flow(n).u + 40, 1e-12);
      EXPECT_NEAR(there.flow(n).du_dy, here.flow(n).du_dy, 1e-9);
    }
  }
}

TEST(KineticStress, ACurvedProfileIsFollowedAndFluctuationsAreFound)
{
  const auto curve = [](double y) { return Vec2{y * (6 - y), 0}; };
  // The linear interpolation over bins 1/8 thick misses a parabola of curvature 2 by about (1/8)^2/4.
  const auto quiet = kinetic({column(curve)}, MeanFlow::profile);
  EXPECT_LT(quiet.mean(1, Species::small).about_mean.kinetic(0, 0),
            0.01 * 0.01 * quiet.mean(1, Species::small).mass);
  const auto noisy = kinetic(std::vector<Packing>{column(curve, 0.3)}, MeanFlow::profile);
  double mass = 0, energy = 0;
  for (std::size_t n = 0; n < noisy.layers(); ++n)
    for (const auto species : {Species::small, Species::large}) {
      mass += noisy.mean(n, species).mass;
      energy += noisy.mean(n, species).about_mean.kinetic.trace();
    }
  // 24 bins of about 12 grains remove a twelfth of the variance.
  EXPECT_NEAR(energy / mass, 2 * 0.09, 0.05);
}

TEST(KineticStress, AGrainCountsWholeAtItsCentreAndBoundaryGrainsDoNotCount)
{
  Packing packing;
  packing.grain(Species::large, 0.4, {1, 0.99}, {1, 0});
  packing.grain(Species::boundary, 0.4, {1, 0}, {5, 0});
  const auto stress = kinetic({packing}, MeanFlow::profile);
  ASSERT_EQ(stress.layers(), 2u);
  EXPECT_NEAR(stress.mean(0, Species::large).mass, pi * 0.16, 1e-15);
  EXPECT_EQ(stress.mean(1, Species::large).mass, 0);
  EXPECT_EQ(stress.flow(0).u, 1);
  EXPECT_TRUE(std::isnan(stress.flow(1).u));
}

TEST(KineticStress, AProfilePassesOverEmptyHeights)
{
  Packing packing;
  for (const double y : {0.05, 0.1, 0.3, 2.4, 2.45, 2.9, 2.95})
    packing.grain(Species::small, 0.02, {1, y}, {4 * y, 0});
  EXPECT_LT(largest(kinetic({packing}, MeanFlow::profile)), 1e-28);
}

// The layer's mean is the same function of height in both frames, so only the common oscillation is
// removed.
TEST(KineticStress, TheInstantaneousMeanTakesAwayWhatTheLayerDoesTogether)
{
  const auto beat = [](double kick) {
    return column([kick](double y) { return Vec2{2 * y + kick, kick}; }, 0.1);
  };
  const std::vector<Packing> swing{beat(0.7), beat(-0.7)};
  const auto still = kinetic({beat(0)}, MeanFlow::layer),
             instant = kinetic(swing, MeanFlow::instant), layer = kinetic(swing, MeanFlow::layer);
  for (std::size_t n = 0; n < 3; ++n)
    for (const auto species : {Species::small, Species::large}) {
      const auto quiet = still.mean(n, species), seen = instant.mean(n, species),
                 loud = layer.mean(n, species);
      EXPECT_TRUE(same(seen.about_mean.kinetic, quiet.about_mean.kinetic, 1e-14));
      EXPECT_NEAR(seen.about_mean.rotational, quiet.about_mean.rotational, 1e-15);
      EXPECT_NEAR(loud.about_mean.kinetic(1, 1), quiet.about_mean.kinetic(1, 1) + quiet.mass * 0.49,
                  1e-13);
    }
}

// With n grains of independent velocities, subtracting their own mean removes 1/n of the variance.
TEST(KineticStress, TheInstantaneousMeanTakesTheShareOfOneGrain)
{
  std::vector<Packing> frames(2);
  for (const double sign : {1.0, -1.0}) {
    auto& packing = frames[sign > 0 ? 0 : 1];
    packing.grain(Species::small, 0.1, {1, 0.5}, {sign * 3, 0});
    packing.grain(Species::small, 0.1, {2, 0.5}, {0, 0});
  }
  const double mass = pi * 0.01;
  const auto total = kinetic(frames, MeanFlow::layer), instant = kinetic(frames, MeanFlow::instant);
  EXPECT_NEAR(total.mean(0, Species::small).about_mean.kinetic(0, 0), mass * 9, 1e-15);
  EXPECT_NEAR(instant.mean(0, Species::small).about_mean.kinetic(0, 0), mass * 9 / 2, 1e-15);
}

// This is true for any choice of the mean flow.
TEST(KineticStress, TheLayerBiasIsWhatTheLayerMeanAddsToTheProfile)
{
  const std::vector<Packing> frames{column(
                                        [](double y) {
                                          return Vec2{y * (6 - y), 0.2 * y};
                                        },
                                        0.3),
                                    column(
                                        [](double y) {
                                          return Vec2{y * (7 - y), 0.1 * y};
                                        },
                                        0.4)};
  const auto profile = kinetic(frames, MeanFlow::profile), layer = kinetic(frames, MeanFlow::layer);
  for (const auto flow : all_means) {
    const auto stress = kinetic(frames, flow);
    for (std::size_t n = 0; n < 3; ++n)
      for (const auto species : {Species::small, Species::large}) {
        const auto bias = stress.mean(n, species).layer_bias;
        const auto about_layer = layer.mean(n, species).about_mean,
                   about_profile = profile.mean(n, species).about_mean;
        EXPECT_TRUE(same(bias.kinetic, about_layer.kinetic - about_profile.kinetic, 1e-13));
        EXPECT_NEAR(bias.rotational, about_layer.rotational - about_profile.rotational, 1e-15);
        EXPECT_GT(bias.kinetic(0, 0), 0.1 * about_profile.kinetic(0, 0));
      }
  }
}

// N equal grains at equal distances: the bias is (1 - 1/N^2) mass (du/dy h)^2/12.
TEST(KineticStress, TheBiasOfALinearShearIsThatOfItsSlope)
{
  constexpr int count = 50;
  Packing packing;
  for (int k = 0; k < count; ++k) {
    const double y = (k + 0.5) / count;
    packing.grain(k % 2 == 0 ? Species::small : Species::large, 0.01, {0.1 * k, y}, {3 * y, 0});
  }
  const auto stress = kinetic({packing}, MeanFlow::profile);
  double bias = 0, of_shear = 0;
  for (const auto species : {Species::small, Species::large}) {
    bias += stress.mean(0, species).layer_bias.kinetic(0, 0);
    of_shear += stress.shear_bias(0, species);
    EXPECT_NEAR(stress.mean(0, species).layer_bias.kinetic(1, 1), 0, 1e-28);
  }
  EXPECT_NEAR(of_shear, count * pi * 1e-4 * 9 / 12, 1e-14);
  EXPECT_NEAR(bias, of_shear * (1 - 1.0 / (count * count)), 1e-14);
}

/// 40000 small and 20000 large grains with Maxwellian velocities about a shear flow: each component
/// has the variance `small` or `large`, r times the spin twice as much.
Packing maxwell(double small, double large)
{
  std::mt19937 random(5);
  std::normal_distribution<double> kick(0, 1);
  Packing packing;
  for (int g = 0; g < 60000; ++g) {
    const bool is_large = g % 3 == 1;
    const double radius = is_large ? 0.02 : 0.01, speed = std::sqrt(is_large ? large : small);
    const double y = 3 * (g + 0.5) / 60000;
    packing.grain(is_large ? Species::large : Species::small, radius, {0.1, y},
                  {4 * y + speed * kick(random), speed * kick(random)},
                  std::sqrt(2.0) * speed * kick(random) / radius);
  }
  return packing;
}

// The standard error of a variance of n numbers is sqrt(2/n): 1.7 % for 6667 in a layer.
TEST(KineticStress, MaxwellsVelocitiesHaveTheirTemperature)
{
  const auto stress = kinetic({maxwell(0.25, 0.09)}, MeanFlow::profile);
  for (std::size_t n = 0; n < 3; ++n) {
    const auto small = stress.mean(n, Species::small), large = stress.mean(n, Species::large);
    EXPECT_NEAR(small.grains, 13333, 1);
    EXPECT_NEAR(large.grains, 6667, 1);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(small.temperature()[axis], 0.25, 4 * 0.017 * 0.25);
      EXPECT_NEAR(large.temperature()[axis], 0.09, 4 * 0.017 * 0.09);
    }
    EXPECT_NEAR(small.about_mean.kinetic(0, 1), 0, 4 * 0.012 * 0.25 * small.mass);
  }
}

// Large grains have four times the mass here.
TEST(KineticStress, EquipartitionIsAQuestionOfEnergyPerGrain)
{
  const auto shared = kinetic({maxwell(0.4, 0.1)}, MeanFlow::profile),
             alike = kinetic({maxwell(0.4, 0.4)}, MeanFlow::profile);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(shared.equipartition(1)[axis], 1, 0.1);
    EXPECT_NEAR(alike.equipartition(1)[axis], 4, 0.4);
  }
  Packing small_alone;
  small_alone.grain(Species::small, 0.1, {1, 0.5}, {1, 0});
  EXPECT_TRUE(kinetic({small_alone}, MeanFlow::profile).equipartition(0).array().isNaN().all());
}

// A cloud of spheres that moves as a whole: only its own fluctuations are counted; the rotational
// part is 2/5 m r^2 dw^2 about each axis.
TEST(KineticStress, OfSpheresHasThreeComponentsAndThreeSpins)
{
  PackingOf<3> packing;
  const Vec3 drift{3, -1, 2}, turning{5, 7, -4};
  const Vec3 kicks[] = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {0.5, 0.5, 0.5}};
  const Vec3 spins[] = {{0.1, 0, 0}, {0, 0.2, 0}, {0, 0, 0.3}, {0.2, 0.2, 0.2}};
  Tensor3 expected = Tensor3::Zero();
  double rotational = 0;
  const double radius = 0.1, mass = 4 * std::numbers::pi / 3 * 0.001;
  for (int k = 0; k < 4; ++k)
    for (const double sign : {1.0, -1.0}) {
      packing.grain(Species::large, radius, {0.3 * k, 0.5, 0.1}, drift + sign * kicks[k],
                    turning + sign * spins[k]);
      expected += mass * kicks[k] * kicks[k].transpose();
      rotational += 0.4 * mass * radius * radius * spins[k].squaredNorm();
    }
  const Layers layers(1, 2, 3);
  MeanVelocity<3> mean(layers, bin);
  mean.add(packing.grains, packing.frame);
  KineticStress<3> stress(layers, MeanFlow::layer, mean);
  stress.add(packing.grains, packing.frame);
  const auto own = stress.mean(0, Species::large);
  EXPECT_TRUE(same(own.about_mean.kinetic, expected, 1e-15));
  EXPECT_NEAR(own.about_mean.rotational, rotational, 1e-17);
  EXPECT_NEAR(own.temperature()[2], expected(2, 2) / (8 * mass), 1e-13);
  EXPECT_NEAR(stress.flow(0).u, 3, 1e-14);
}

TEST(KineticStress, ColumnsAndNumbersAgreeInCount)
{
  const auto stress = kinetic({column([](double) { return Vec2{1, 0}; })}, MeanFlow::layer);
  const auto species = two_sizes(1, 2);
  EXPECT_EQ(stress.cells(species, std::nullopt).size(), stress.cells(species, 0).size());
}

}  // namespace
}  // namespace grseg
