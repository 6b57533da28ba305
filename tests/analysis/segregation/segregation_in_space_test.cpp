// SPDX-License-Identifier: GPL-3.0-or-later
// Segregation of spheres along y.
#include "analysis/segregation/flux.hpp"
#include "analysis/segregation/rates.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace grseg {
namespace {

using std::numbers::pi;
using Spheres = PackingOf<3>;

const Layers slabs(1, 10, 7);
const Window eight_seconds{2, 10, {}};  // its eight parts last 1 s each

/// Four small spheres and a large one (masses 1:8) in the upper of two layers, three small ones in
/// the lower one.
Spheres mixture_of_spheres()
{
  Spheres scene;
  for (const double y : {1.2, 1.4, 1.6, 1.8}) scene.grain(Species::small, 0.01, {1, y, 1.5});
  scene.grain(Species::large, 0.02, {3, 1.5, 1.5});
  for (const double y : {0.2, 0.5, 0.8}) scene.grain(Species::small, 0.01, {4, y, 0.5});
  return scene;
}

template <class Move>
SegregationFlux<3> watched(Spheres scene, const Move& move)
{
  SegregationFlux<3> flux(slabs, eight_seconds, 0.02, 0.04);
  for (int k = 0; k < 16; ++k) {
    scene.frame.time = 2 + 0.5 * k;
    move(scene, 0.5 * k);
    flux.add(scene.grains, scene.frame);
  }
  return flux;
}

// v = 0.1 for the small spheres, 0.4 for the large one: w = (4*0.1 + 8*0.4)/12 = 0.3, phi_L = 2/3.
TEST(SegregationInSpace, AKnownFluxIsFound)
{
  const auto scene = mixture_of_spheres();
  const auto flux = watched(scene, [](Spheres& s, double) {
    for (std::size_t g = 0; g < 8; ++g)
      s.frame.velocity[g] = {5, g == 4 ? 0.4 : 0.1, g == 4 ? -3. : 2.};
  });
  const auto layer = flux.results(scene.grains, 2)[1];
  EXPECT_NEAR(layer.value.phi_large, 2.0 / 3, 1e-14);
  EXPECT_NEAR(layer.value.w_large, 0.1, 1e-14);
  EXPECT_NEAR(layer.value.w_small, -0.2, 1e-14);
  EXPECT_NEAR(layer.value.q_large, 0.2 / 3, 1e-14);
  EXPECT_NEAR(layer.value.q_small, -0.2 / 3, 1e-14);
  EXPECT_NEAR(layer.flow.v, 0.3, 1e-14);
  std::map<std::string, double> cells;
  for (const auto& cell : layer.cells(3)) cells[cell.column] = cell.value;
  EXPECT_NEAR(cells.at("volume_L[m^3]"), 4 * pi / 3 * 8e-6, 1e-18);
  EXPECT_NEAR(cells.at("volume_S[m^3]"), 4 * pi / 3 * 4e-6, 1e-18);
  EXPECT_NEAR(cells.at("v[m/s]"), 0.3, 1e-14);
}

// Small spheres part along y with +-c: D = c^2 t 4/(2 * 3). Motion across y does not count.
TEST(SegregationInSpace, DiffusionIsAlongTheNormal)
{
  constexpr double c = 0.01;
  const auto scene = mixture_of_spheres();
  const auto flux = watched(scene, [&](Spheres& s, double t) {
    for (std::size_t g = 0; g < 4; ++g) {
      const double sign = g % 2 == 0 ? 1 : -1;
      s.frame.position[g] = scene.frame.position[g] + Vec3(0.3, sign * c, sign * 0.05) * t;
    }
  });
  const auto value = flux.results(scene.grains, 2)[1].value;
  EXPECT_NEAR(value.D_small, 4 * c * c / (2 * 3), 1e-15);
  EXPECT_NEAR(value.D2_small, 2 * value.D_small, 1e-15);
}

// Layers of 50 equal spheres, all of one composition: s_0^2/(s_0^2 - s_r^2) = 50/49; and separated layers.
TEST(SegregationInSpace, TheMixingIndexIsThatOfVolumes)
{
  const auto bed = [](const auto& large) {
    Spheres scene;
    for (int layer = 0; layer < 20; ++layer)
      for (int g = 0; g < 50; ++g)
        scene.grain(g < large(layer) ? Species::large : Species::small, 0.01,
                    {0.1 * g, layer + 0.5, 0.1 * g});
    return mixing_index(slabs, scene.grains, scene.frame);
  };
  EXPECT_NEAR(bed([](int) { return 20; }), 50.0 / 49, 1e-12);
  EXPECT_NEAR(bed([](int layer) { return layer < 8 ? 50 : 0; }), 0, 1e-12);
}

// phi_L = 8/9: one large sphere and one small sphere of half its size in each of two layers. s^2 =
// 0 and s_r^2/s_0^2 = 2 (1/9 8 + 8/9 1)/18.
TEST(SegregationInSpace, ARandomMixtureOfSpheresVariesByTheirVolumes)
{
  Spheres scene;
  for (const double y : {0.5, 1.5}) {
    scene.grain(Species::large, 0.02, {1, y, 1});
    scene.grain(Species::small, 0.01, {2, y, 1});
  }
  const double random = 2 * (8.0 / 9 + 8.0 / 9) / 18;
  EXPECT_NEAR(mixing_index(slabs, scene.grains, scene.frame), 1 / (1 - random), 1e-12);
}

TEST(SegregationInSpace, RowsOfARunHaveTheirColumns)
{
  const auto scene = mixture_of_spheres();
  SegregationSeries<3> series(slabs);
  SegregationFlux<3> flux(slabs, eight_seconds, 0.02, 0.04);
  for (int k = 0; k < 16; ++k) {
    auto now = scene;
    now.frame.time = 2 + 0.5 * k;
    for (std::size_t g = 0; g < 8; ++g) {
      auto& position = now.frame.position[g];
      position.z() = 1 + 0.1 * static_cast<double>(g % 5);
      now.frame.velocity[g] = {3 * position.y(), 0, 9};
    }
    series.add(now.grains, now.frame);
    flux.add(now.grains, now.frame);
  }
  SegregationTable<3> run(slabs, 0.02, 0.04);
  run.add(scene.grains, series, flux);
  const auto columns = SegregationTable<3>::columns();
  EXPECT_EQ(columns[0], "volume_S[m^3]");
  ASSERT_EQ(run.row(1).size(), columns.size());
  const auto bed = run.bed_row();
  const auto at = [&](const char* name) {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                    columns.begin());
  };
  // Volume 1 at each of 0.2 to 0.8, 4 about 1.5, 8 at 1.5.
  EXPECT_NEAR(bed[at("height[m]")], 2 * (1.5 + 12 * 1.5) / 15, 1e-13);
  EXPECT_NEAR(bed[at("yL[m]")], 1.5, 1e-14);
  EXPECT_NEAR(bed[at("shear_rate[1/s]")], 3, 1e-12);
  EXPECT_NEAR(bed[at("strain")], 3 * 3.75, 1e-12);
}

}  // namespace
}  // namespace grseg
