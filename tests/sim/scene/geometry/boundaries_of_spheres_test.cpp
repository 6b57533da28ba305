// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/deposition.hpp"
#include "sim/scene/geometry.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace grseg {
namespace {

using Words = std::vector<std::string>;

/// The base of such a cell consists of touching lines of touching spheres.
Scene spheres(const Words& more)
{
  Words words{"--dimension", "3",       "--length", "17.3205dL",  "--width", "6dL",      "--depth",
              "8dS",         "--slope", "0",        "--accuracy", "draft",   "--spread", "0"};
  words.insert(words.end(), more.begin(), more.end());
  return small_chute::paper_scene(words);
}

/// Diameter, in d_L, of the largest sphere whose centre can lie in the plane of the base.
double widest_hole(const Scene& scene)
{
  const auto boundaries = scene.geometry->boundaries(scene);
  const double plane = boundaries.position.front().y(), length = scene.length, width = scene.width;
  const auto nearest = [](double along, double period, bool periodic) {
    return periodic ? along - period * std::round(along / period) : along;
  };
  const bool x_periodic = scene.lateral == Scene::Lateral::periodic;
  const bool z_periodic = scene.sides == Scene::Lateral::periodic;
  constexpr int points = 300;  // a row and a column of them are 0.06 and 0.02 d_L apart
  double widest = 0;
  for (int k = 0; k <= points; ++k)
    for (int n = 0; n <= points; ++n) {
      const double x = k * length / points, z = n * width / points;
      double free = length;
      if (!x_periodic) free = std::min({free, x, length - x});
      if (!z_periodic) free = std::min({free, z, width - z});
      for (std::size_t b = 0; b < boundaries.position.size() && free > widest / 2; ++b) {
        const Vec3& bead = boundaries.position[b];
        EXPECT_EQ(bead.y(), plane);
        free = std::min(free, std::hypot(nearest(x - bead.x(), length, x_periodic),
                                         nearest(z - bead.z(), width, z_periodic)) -
                                  boundaries.radius[b]);
      }
      widest = std::max(widest, 2 * free);
    }
  return widest / scene.large_diameter;
}

/// Largest size ratio, to 0.01, that a scene may have.
double largest_ratio(const Words& more)
{
  for (int hundredths = 700; hundredths > 100; --hundredths) {
    auto words = more;
    words.insert(words.end(), {"--size-ratio", std::to_string(0.01 * hundredths)});
    try {
      spheres(words);
      return 0.01 * hundredths;
    } catch (const SceneError&) {
    }
  }
  return 1;
}

// Grains may be 1/0.9 times as wide as the holes. The points of widest_hole() miss a hole's middle by
// up to 0.03 d_L, where the sphere is smaller by up to twice as much.
TEST(BoundariesOfSpheres, AreClosedForTheSmallestGrainsThatScenesMayHave)
{
  const Words ends{"--lateral", "walls"}, sides{"--sides", "walls"};
  const Words both{"--lateral", "walls", "--sides", "walls"};
  const Words hopper{"--geometry", "hopper", "--lateral", "walls", "--outlet", "6dS"};
  for (const auto& words : {Words{}, ends, sides, both, hopper}) {
    const double hole = widest_hole(spheres(words)), allowed = 0.9 / largest_ratio(words);
    EXPECT_LE(hole, allowed + 0.002);
    // The lines of a hopper may reach into the walls, which makes holes there narrower.
    if (words != hopper) {
      EXPECT_GE(hole, allowed - 0.06);
    }
  }
}

/// Number of mobile grains below the base.
int below(const Simulation<3>& simulation)
{
  const auto& grains = simulation.world().grains;
  int count = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (!grains.fixed[g] && simulation.position(g).y() < -2 * grains.radius[g]) ++count;
  return count;
}

TEST(BoundariesOfSpheres, LeaveAnOutletOfTheRequestedSize)
{
  for (const auto* shape : {"slot", "round"}) {
    const auto scene = spheres({"--geometry", "hopper", "--lateral", "walls", "--sides", "walls",
                                "--outlet", "6dS", "--outlet-shape", shape});
    const auto deposited = deposit<3>(scene);
    EXPECT_EQ(below(deposited), 0) << shape;
    auto simulation = release(deposited, scene);
    const auto& fixed = simulation.world().grains.fixed;
    const auto distance = [&](const Vec3& at) {
      const double x = at.x() - scene.length / 2, z = at.z() - scene.width / 2;
      return std::string(shape) == "slot" ? std::abs(x) : std::hypot(x, z);
    };
    double nearest = scene.length;
    for (std::size_t g = 0; g < fixed.size(); ++g)
      if (fixed[g]) nearest = std::min(nearest, distance(simulation.position(g)));
    const double opening = 2 * nearest - scene.large_diameter;
    EXPECT_GE(opening, scene.outlet * (1 - 1e-12)) << shape;
    EXPECT_LE(opening, scene.outlet + scene.large_diameter) << shape;
    while (simulation.time() < 0.15) simulation.advance();
    EXPECT_GT(below(simulation), 10) << shape;
  }
}

TEST(BoundariesOfSpheres, ADrumWithEndWallsKeepsItsGrains)
{
  const auto scene = small_chute::paper_scene(
      {"--dimension", "3",    "--width",    "6dL",   "--sides",         "walls",
       "--slope",     "0",    "--accuracy", "draft", "--spread",        "0",
       "--geometry",  "drum", "--lateral",  "walls", "--drum-diameter", "30dS",
       "--drum-rate", "3",    "--fill",     "0.3"});
  auto simulation = release(deposit<3>(scene), scene);
  while (simulation.time() < 0.5) simulation.advance();
  const auto& grains = simulation.world().grains;
  const Vec2 centre{scene.length / 2, scene.drum_diameter / 2};
  int mobile = 0;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (grains.fixed[g]) continue;
    ++mobile;
    const auto at = simulation.position(g);
    EXPECT_LT((at.head<2>() - centre).norm(), (scene.drum_diameter + scene.large_diameter) / 2);
    EXPECT_GT(at.z(), 0.9 * grains.radius[g]);
    EXPECT_LT(at.z(), scene.width - 0.9 * grains.radius[g]);
  }
  EXPECT_GT(mobile, 300);
}

// Froude numbers of 1.2 and 4.9. A grain that meets the ring may overlap with it by its way in one
// step. Grains that turn with the ring must not sink: they did, by omega^2 R h/2 per second, up to
// 0.2 d_S.
TEST(DrumOfSpheres, AboveFroudeOneDoesNotPressGrainsIntoItsRing)
{
  for (const char* rate : {"20", "40"}) {
    const auto scene = small_chute::paper_scene(
        {"--dimension", "3", "--geometry", "drum", "--lateral", "walls", "--drum-diameter", "12dS",
         "--width", "8dS", "--fill", "0.3", "--drum-rate", rate, "--accuracy", "draft"});
    auto simulation = release(deposit<3>(scene), scene);
    double overlap = 0, way = 0, mean = 0;
    while (simulation.time() < 1) {
      const auto report = simulation.advance();
      overlap = std::max(overlap, report.largest_overlap);
      way = std::max(way, report.farthest_approach);
      mean = report.sum_overlap / static_cast<double>(std::max<std::size_t>(report.touching, 1));
    }
    EXPECT_LT(overlap, way) << rate;
    EXPECT_LT(mean, 1e-3 * scene.small_diameter) << rate;  // above, a run is in doubt
  }
}

}  // namespace
}  // namespace grseg
