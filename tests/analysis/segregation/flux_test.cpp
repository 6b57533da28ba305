// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/flux.hpp"

#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace grseg {
namespace {

const Layers layers(1, 10);
const Window window{2, 10, {}};  // its eight parts last 1 s each
constexpr double small_diameter = 0.02, large_diameter = 0.04;

using Move = std::function<void(Packing&, double)>;

/// Equally spaced frames over the window; `move` gets the time since the window's begin, s.
std::vector<Packing> film(Packing scene, int frames, const Move& move)
{
  std::vector<Packing> all;
  for (int k = 0; k < frames; ++k) {
    scene.frame.time = window.begin + (window.end - window.begin) * k / frames;
    move(scene, scene.frame.time - window.begin);
    all.push_back(scene);
  }
  return all;
}

SegregationFlux<2> seen(const std::vector<Packing>& frames)
{
  SegregationFlux<2> flux(layers, window, small_diameter, large_diameter);
  for (const auto& scene : frames) flux.add(scene.grains, scene.frame);
  return flux;
}

SegregationFlux<2> seen(const Packing& scene, int frames, const Move& move)
{
  return seen(film(scene, frames, move));
}

/// Two small grains and one large grain (masses 1:1:4) in the upper of two layers, three small
/// grains in the lower one.
Packing mixture()
{
  Packing scene;
  scene.grain(Species::small, 0.01, {1, 1.3});
  scene.grain(Species::small, 0.01, {2, 1.7});
  scene.grain(Species::large, 0.02, {3, 1.5});
  for (const double y : {0.2, 0.5, 0.8}) scene.grain(Species::small, 0.01, {4, y});
  return scene;
}

// v = 0.1 for the small grains, 0.4 for the large one: w = (2*0.1 + 4*0.4)/6 = 0.3, phi_L = 2/3.
TEST(SegregationFlux, AKnownFluxIsFound)
{
  const Packing scene = mixture();
  const auto flux = seen(scene, 16, [](Packing& s, double) {
    s.frame.velocity = {{5, 0.1}, {6, 0.1}, {7, 0.4}, {0, 0.2}, {0, 0.2}, {0, 0.2}};
  });
  const auto layer = flux.results(scene.grains, 2)[1];
  EXPECT_NEAR(layer.value.phi_large, 2.0 / 3, 1e-14);
  EXPECT_NEAR(layer.value.w_large, 0.1, 1e-14);
  EXPECT_NEAR(layer.value.w_small, -0.2, 1e-14);
  EXPECT_NEAR(layer.value.q_large, 0.2 / 3, 1e-14);
  EXPECT_NEAR(layer.value.q_small, -0.2 / 3, 1e-14);
  EXPECT_NEAR(layer.error.q_large, 0, 1e-14);
  EXPECT_NEAR(layer.flow.v, 0.3, 1e-14);
  EXPECT_NEAR(layer.content_large, std::numbers::pi * 4e-4, 1e-15);
  const auto pure = flux.results(scene.grains, 2)[0];
  EXPECT_EQ(pure.value.phi_large, 0);
  EXPECT_EQ(pure.value.w_small, 0);
  EXPECT_EQ(pure.value.q_large, 0);
  EXPECT_TRUE(std::isnan(pure.value.w_large));
  EXPECT_TRUE(std::isnan(pure.value.S));
}

// The large grain of the same mixture is twice as dense. Areas are 1:1:4 still, so nothing changes.
TEST(SegregationFlux, TheFluxesOfTwoDensitiesCancelAndAreOfArea)
{
  Packing scene = mixture();
  scene.grains.mass[2] *= 2;
  const auto flux = seen(scene, 16, [](Packing& s, double) {
    s.frame.velocity = {{5, 0.1}, {6, 0.1}, {7, 0.4}, {0, 0.2}, {0, 0.2}, {0, 0.2}};
  });
  const auto layer = flux.results(scene.grains, 2)[1];
  EXPECT_NEAR(layer.value.w_large, 0.1, 1e-14);
  EXPECT_NEAR(layer.value.q_large, 0.2 / 3, 1e-14);
  EXPECT_NEAR(layer.value.q_small, -0.2 / 3, 1e-14);
  EXPECT_NEAR(layer.error.q_large, 0, 1e-14);
}

// A layer that oscillates does not segregate, even if its large grains are present only while it rises.
TEST(SegregationFlux, TheMotionOfTheLayerAsAWholeDropsOut)
{
  const Packing scene = mixture();
  const auto flux = seen(scene, 16, [](Packing& s, double t) {
    const bool up = std::fmod(t, 1) < 0.5;
    for (auto& velocity : s.frame.velocity) velocity = {0, up ? 3 : -3};
    s.frame.position[2].y() = up ? 1.5 : 0.5;
  });
  for (const auto& layer : flux.results(scene.grains, 2)) {
    EXPECT_NEAR(layer.value.q_large, 0, 1e-15);
    EXPECT_NEAR(layer.value.w_small, 0, 1e-15);
  }
}

// The flux is +0.1 in four parts and -0.1 in four: mean 0, standard error
// sqrt(sum 0.1^2/(8 * 7)) phi = 0.1/sqrt(7) phi.
TEST(SegregationFlux, TheErrorIsThatOfTheMeanOfEightParts)
{
  const Packing scene = mixture();
  const auto flux = seen(scene, 32, [](Packing& s, double t) {
    const double sign = std::fmod(t, 2) < 1 ? 1 : -1;
    s.frame.velocity[0] = s.frame.velocity[1] = {0, -0.2 * sign};
    s.frame.velocity[2] = {0, 0.1 * sign};
  });
  const auto layer = flux.results(scene.grains, 2)[1];
  EXPECT_NEAR(layer.value.w_large, 0, 1e-14);
  EXPECT_NEAR(layer.error.w_large, 0.1 / std::sqrt(7), 1e-14);
  EXPECT_NEAR(layer.error.q_large, 0.2 / 3 / std::sqrt(7), 1e-14);
}

// Drift is not diffusion: each species rises at its own speed.
TEST(SegregationFlux, ASteadyDriftHasNoDiffusivity)
{
  const Packing scene = mixture();
  const auto flux = seen(scene, 16, [&](Packing& s, double t) {
    for (std::size_t g = 0; g < 6; ++g)
      s.frame.position[g].y() = scene.frame.position[g].y() + (g == 2 ? 0.01 : 0.02) * t;
  });
  EXPECT_NEAR(flux.results(scene.grains, 2)[1].value.D_small, 0, 1e-28);
  EXPECT_NEAR(flux.results(scene.grains, 2)[0].value.D2_small, 0, 1e-28);
  EXPECT_TRUE(std::isnan(flux.results(scene.grains, 2)[1].value.D_large));  // one grain: all drift
}

// Two small grains part with velocities +-c. The sum of squares 2 (c t)^2, over one degree of
// freedom and over 2 t, is D = c^2 t, which doubles with the lag: ballistic motion is recognised.
TEST(SegregationFlux, BallisticMotionHasADiffusivityThatGrowsWithTheLag)
{
  constexpr double c = 0.01;
  const Packing scene = mixture();
  const auto flux = seen(scene, 16, [&](Packing& s, double t) {
    s.frame.position[0].y() = 1.3 + c * t;
    s.frame.position[1].y() = 1.7 - c * t;
  });
  const auto value = flux.results(scene.grains, 2)[1].value;
  EXPECT_NEAR(value.D_small, c * c * 1, 1e-15);
  EXPECT_NEAR(value.D2_small, c * c * 2, 1e-15);
}

// Darken's relation: the rarer a species, the closer the composition's diffusivity is to its own.
TEST(SegregationFlux, TheCompositionDiffusesAsItsRarerSpecies)
{
  Packing scene;
  for (const double y : {1.2, 1.4}) scene.grain(Species::small, 0.01, {1, y});
  for (const double y : {1.6, 1.8}) scene.grain(Species::large, 0.02, {2, y});
  const auto flux = seen(scene, 8, [&](Packing& s, double t) {
    for (std::size_t g = 0; g < 4; ++g)
      s.frame.position[g].y() =
          scene.frame.position[g].y() + (g % 2 == 0 ? 1 : -1) * (g < 2 ? 0.01 : 0.005) * t;
  });
  const auto value = flux.results(scene.grains, 2)[1].value;
  EXPECT_NEAR(value.phi_large, 0.8, 1e-14);
  EXPECT_NEAR(value.D_small, 1e-4, 1e-16);
  EXPECT_NEAR(value.D_large, 2.5e-5, 1e-16);
  EXPECT_NEAR(value.D, 0.2 * 2.5e-5 + 0.8 * 1e-4, 1e-16);
}

/// In the middle of each of three layers, 40 small and 20 large grains walk at random with D = 2e-4
/// and 1e-4 m^2/s; each species also drifts.
std::vector<Packing> walk(unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> kick(0, 1);
  Packing scene;
  for (int layer = 0; layer < 3; ++layer)
    for (int g = 0; g < 60; ++g)
      scene.grain(g < 40 ? Species::small : Species::large, g < 40 ? 0.01 : 0.02,
                  {0.1 * g, layer + 0.4 + 0.2 * g / 60}, {layer + 1.0 * g / 60, 0});
  return film(scene, 64, [&](Packing& s, double) {
    for (std::size_t g = 0; g < s.grains.size(); ++g) {
      const bool large = s.grains.species[g] == Species::large;
      const double D = large ? 1e-4 : 2e-4, dt = 1.0 / 8;
      s.frame.position[g].y() += (large ? 1e-3 : -2e-3) * dt + std::sqrt(2 * D * dt) * kick(random);
    }
  });
}

// Jackknife errors of 7 displacements have about six degrees of freedom: t = 2.45.
TEST(SegregationFlux, ARandomWalkHasItsDiffusivityWithinItsError)
{
  double mean_small = 0, mean_large = 0;
  int held = 0, held_twice = 0, count = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const auto frames = walk(seed);
    const auto results = seen(frames).results(frames[0].grains, 3);
    ASSERT_EQ(results.size(), 3u);
    EXPECT_EQ(results[0].displacements[0], 7 * 39);
    EXPECT_EQ(results[0].displacements[1], 7 * 19);
    for (const auto& layer : results) {
      mean_small += layer.value.D_small / 300;
      mean_large += layer.value.D_large / 300;
      held += std::abs(layer.value.D_small - 2e-4) < 2.45 * layer.error.D_small ? 1 : 0;
      held += std::abs(layer.value.D_large - 1e-4) < 2.45 * layer.error.D_large ? 1 : 0;
      held_twice += std::abs(layer.value.D2_small - 2e-4) < 2.45 * layer.error.D2_small ? 1 : 0;
      ++count;
    }
  }
  EXPECT_NEAR(mean_small, 2e-4, 4 * 2e-4 * std::sqrt(2.0 / (300 * 7 * 39)));
  EXPECT_NEAR(mean_large, 1e-4, 4 * 1e-4 * std::sqrt(2.0 / (300 * 7 * 19)));
  EXPECT_GT(held, 0.92 * 2 * count);
  EXPECT_LT(held, 0.98 * 2 * count);
  EXPECT_GT(held_twice, 0.75 * count);
}

// phi_L = 1/2 at y = 1.5, between 1/5 at 0.5 and 4/5 at 2.5: gradient 0.3. With w_L - w = 0.1 and
// no diffusivity, S = 0.05/0.25; D = 2e-4 adds 2e-4*0.3.
TEST(SegregationFlux, TheFluxIsSplitIntoSegregationAndDiffusion)
{
  Packing scene;
  const auto fill = [&](double y, int small, int large) {
    for (int g = 0; g < small; ++g) scene.grain(Species::small, 0.02, {0.1 * g, y}, {3 * y, -0.1});
    for (int g = 0; g < large; ++g) scene.grain(Species::large, 0.02, {0.1 * g, y}, {3 * y, 0.1});
  };
  fill(0.5, 8, 2);
  fill(1.5, 5, 5);
  fill(2.5, 2, 8);
  const double step = std::sqrt(2 * 2e-4);  // +-step per 1 s: variance 2 D t, except for n/(n - 1)
  const auto flux = seen(scene, 8, [&](Packing& s, double t) {
    const double side = static_cast<int>(t + 0.5) % 2 == 0 ? 0 : step;
    for (std::size_t g = 10; g < 20; ++g) {
      const std::size_t own = (g - 10) % 5;
      const double sign = own == 4 ? 0 : own % 2 == 0 ? 1 : -1;
      s.frame.position[g].y() = 1.5 + sign * side;
    }
  });
  const auto value = flux.results(scene.grains, 3)[1].value;
  EXPECT_NEAR(value.D_small, 2e-4, 1e-15);  // four of five grains move: 4 step^2/4
  EXPECT_NEAR(value.D, 2e-4, 1e-15);
  EXPECT_NEAR(value.gradient, 0.3, 1e-12);
  EXPECT_NEAR(value.q_large, 0.05, 1e-14);
  EXPECT_NEAR(value.S, (0.05 + 2e-4 * 0.3) / 0.25, 1e-12);
  EXPECT_NEAR(value.peclet, value.S * 3 / 2e-4, 1e-8);
}

TEST(SegregationFlux, DiffusivitiesAreMeasuredInShearAndMeanDiameter)
{
  Packing scene = mixture();
  const auto flux = seen(scene, 16, [&](Packing& s, double t) {
    s.frame.velocity = {{5, 0}, {6, 0}, {5.5, 0}, {0, 0}, {0, 0}, {0, 0}};
    s.frame.position[0].y() = 1.3 + 1e-9 * t;
    s.frame.position[1].y() = 1.7 - 1e-9 * t;
  });
  const auto value = flux.results(scene.grains, 2)[1].value;
  const double d = (small_diameter + 2 * large_diameter) / 3, shear = 1 / 0.4;
  EXPECT_NEAR(value.Dhat_small * shear * d * d / value.D_small, 1, 1e-6);
}

TEST(SegregationFlux, FramesMayBeAddedInParts)
{
  const auto frames = walk(3);
  SegregationFlux<2> sum(layers, window, small_diameter, large_diameter);
  for (std::size_t k = 0; k < frames.size(); k += 3)
    sum.merge(seen({frames.begin() + static_cast<std::ptrdiff_t>(k),
                    frames.begin() + static_cast<std::ptrdiff_t>(std::min(k + 3, frames.size()))}));
  const auto& grains = frames[0].grains;
  const auto parts = sum.results(grains, 3), once = seen(frames).results(grains, 3);
  ASSERT_EQ(parts.size(), once.size());
  for (std::size_t n = 0; n < once.size(); ++n) {
    EXPECT_EQ(parts[n].value.D_small, once[n].value.D_small);
    EXPECT_EQ(parts[n].error.D2_large, once[n].error.D2_large);
    EXPECT_NEAR(parts[n].value.phi_large, once[n].value.phi_large, 1e-14);
    EXPECT_NEAR(parts[n].content_small, once[n].content_small, 1e-14);
  }
}

TEST(SegregationFlux, OfASingleFrameDiffusivitiesAndErrorsAreUnknown)
{
  const Packing scene = mixture();
  const auto result = seen(scene, 1, [](Packing&, double) {}).results(scene.grains, 2)[0];
  EXPECT_TRUE(std::isnan(result.value.D_small));
  EXPECT_TRUE(std::isnan(result.error.phi_large));
}

// Large grains fall freely, small ones are at rest; 15 of the 16 intervals are between two frames.
TEST(SegregationFlux, TheMomentumGainedIsTheForceOverTheWindowAlsoOfItsParts)
{
  const Packing scene = mixture();
  const auto frames = film(scene, 16, [](Packing& s, double time) {
    s.frame.velocity.assign(6, {1, 0});
    s.frame.velocity[2].y() = 0.5 - 9 * time;
  });
  auto merged = seen({frames.begin() + 9, frames.end()});
  merged.merge(seen({frames.begin(), frames.begin() + 9}));
  for (const auto& flux : {seen(frames), merged}) {
    const auto result = flux.results(scene.grains, 2);
    EXPECT_NEAR(result[1].momentum[1].gain, -9 * std::numbers::pi * 4e-4, 1e-15);
    EXPECT_EQ(result[1].momentum[0].gain, 0);
    EXPECT_EQ(result[0].momentum[1].gain, 0);
  }
  const auto single = seen(scene, 1, [](Packing&, double) {}).results(scene.grains, 2);
  EXPECT_TRUE(std::isnan(single[1].momentum[1].gain));
}

TEST(SegregationFlux, EveryNumberStandsUnderItsColumn)
{
  const Packing scene = mixture();
  const auto flux = seen(scene, 16, [](Packing& s, double) {
    s.frame.velocity = {{5, 0.1}, {6, 0.1}, {7, 0.4}, {0, 0.2}, {0, 0.2}, {0, 0.2}};
  });
  const auto result = flux.results(scene.grains, 2)[1];
  std::map<std::string, double> cells;
  for (const auto& cell : result.cells(2)) cells[cell.column] = cell.value;
  EXPECT_EQ(cells.size(), 7 + 2 * 15u + 6);
  const double mass = std::numbers::pi * 4e-4;  // mass of the large grain
  EXPECT_NEAR(cells.at("mass_L[kg]"), mass, 1e-15);
  EXPECT_NEAR(cells.at("mass_S[kg]"), mass / 2, 1e-15);
  EXPECT_NEAR(cells.at("mvv_L_yy[J]"), mass * 0.16, 1e-15);
  EXPECT_NEAR(cells.at("mvv_S_yy[J]"), mass / 2 * 0.01, 1e-15);
  EXPECT_NEAR(cells.at("gain_L_y[N]"), 0, 1e-15);
  EXPECT_NEAR(cells.at("area_L[m^2]"), std::numbers::pi * 4e-4, 1e-15);
  EXPECT_NEAR(cells.at("v[m/s]"), 0.3, 1e-14);
  EXPECT_NEAR(cells.at("w_S[m/s]"), -0.2, 1e-14);
  EXPECT_NEAR(cells.at("q_L[m/s]"), 0.2 / 3, 1e-14);
  EXPECT_EQ(cells.at("displacements_S"), result.displacements[0]);
  EXPECT_EQ(cells.at("D_S_error[m^2/s]"), result.error.D_small);
}

}  // namespace
}  // namespace grseg
