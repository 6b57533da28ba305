// SPDX-License-Identifier: GPL-3.0-or-later
// Structure of contacts between spheres.
#include "analysis/frames/layer_key.hpp"
#include "analysis/micro/derived_quantities.hpp"
#include "analysis/micro/force_distribution.hpp"
#include "analysis/micro/structure_sums.hpp"
#include "analysis/micro/sums_table.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "tests/analysis/grain_builder.hpp"
#include "tests/analysis/micro/sums_rows.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>

namespace grseg {
namespace {

using std::numbers::pi;
using Spheres = PackingOf<3>;

const Layers slabs(1, 10, 7);
const Layers one_slab(20, 10, 7);
const ForceMeasure normal_over_ends{ContactForce::normal, ForceAverage::ends};

StructureByLayer<3> structure_of(const Spheres& scene, const Layers& layers, double friction = 0.5)
{
  StructureByLayer<3> micro(layers, GrainArea::clipped, friction);
  micro.add(scene.grains, scene.frame);
  return micro;
}

std::map<std::string, double> named(const std::vector<Cell>& cells)
{
  std::map<std::string, double> all;
  for (const auto& cell : cells) all[cell.column] = cell.value;
  return all;
}

/// Spheres that touch along a winding chain which ends on the base. Each species has one size;
/// forces have different magnitudes and directions.
Spheres chain(double tangential)
{
  Spheres scene;
  Vec3 place{3, 1, 2};
  auto before = scene.grain(Species::boundary, 1, {3, -1, 2});
  double radius_before = 1;
  for (int g = 0; g < 9; ++g) {
    const bool large = g % 4 < 2;
    const double radius = large ? 1 : 0.5, angle = 0.5 + 0.3 * g;
    const Vec3 n = Vec3(std::cos(angle), std::sin(angle), 0.4 * g - 1).normalized();
    const Vec3 t = n.cross(Vec3(1, 2, 0.5 * g)).normalized();
    if (g > 0) place += (radius_before + radius) * n;
    const auto grain = scene.grain(large ? Species::large : Species::small, radius, place);
    const Vec3 force = g > 0 ? Vec3((1.0 + g * g % 5) * n + tangential * t) : Vec3(0.3, 2, -0.7);
    scene.contact(grain, before, force);
    before = grain;
    radius_before = radius;
  }
  return scene;
}

// tr sigma^nu = (1/V) sum of r f_n over contact ends on nu; the volume of n grains is n pi/6 d^3.
TEST(StructureInSpace, OverEndsAndOfNormalForcesTheEstimateIsThePressureOfEachSpecies)
{
  const auto sums = structure_of(chain(0.7), one_slab).mean();
  const auto estimate = estimate_pressure(sums, normal_over_ends, 1, 2);
  const auto stress = sums.stress(PartitionRule{});
  EXPECT_NEAR(estimate.small, stress.small().trace() / 3, 1e-14);
  EXPECT_NEAR(estimate.large, stress.large().trace() / 3, 1e-14);
  EXPECT_NEAR(estimate.total(), stress.total.trace() / 3, 1e-14);
  EXPECT_GT(estimate.small, 0.1);
}

// Six contacts of force f on each sphere of diameter d: sigma = (1/d^3) f d in each direction; per
// volume of grains 6/pi times that.
TEST(StructureInSpace, ACubicPackingHasSixContactsAndThePressureOfItsForces)
{
  constexpr double f = 5;
  constexpr std::int32_t side = 3;
  Spheres scene;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) scene.grain(Species::large, 1, {2. * x, 1 + 2. * y, 2. * z});
  const auto at = [&](int x, int y, int z) {
    return (x % side * side + y % side) * side + z % side;
  };
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) {
        scene.image_contact(at(x, y, z), at(x + 1, y, z), {-f, 0, 0}, {-2, 0, 0});
        scene.image_contact(at(x, y, z), at(x, y + 1, z), {0, -f, 0}, {0, -2, 0});
        scene.image_contact(at(x, y, z), at(x, y, z + 1), {0, 0, -f}, {0, 0, -2});
      }
  const auto sums = structure_of(scene, one_slab).mean();
  EXPECT_EQ(sums.coordination(Species::large), 6);
  EXPECT_NEAR(sums.of(Species::large).content, 27 * 4 * pi / 3, 1e-12);
  const double pressure = f / 4 * 6 / pi;
  EXPECT_NEAR(sums.stress(PartitionRule{}).large().trace() / 3, pressure, 1e-14);
  EXPECT_NEAR(estimate_pressure(sums, normal_over_ends, 1, 2).large, pressure, 1e-14);
  const auto& contacts = sums.of(PairType::LL);
  EXPECT_NEAR(anisotropy(contacts.fabric, contacts.contacts, contacts.normal).a_c, 0, 1e-14);
}

TEST(StructureInSpace, NeutralContactsHaveNoSegregationAndTheNeutralShareOfDiscs)
{
  for (const double size_ratio : {1.5, 2.0, 3.0})
    for (const double phi : {0.1, 0.5, 0.9}) {
      const auto sums = neutral_contacts<3>(phi, size_ratio);
      EXPECT_NEAR(sums.mixed_share(), neutral_mixed_share(phi, size_ratio), 1e-14);
      const auto stress = sums.stress(PartitionRule{});
      EXPECT_NEAR(
          local_b(partition_slope(stress.small().trace(), stress.large().trace(), phi), phi), 0,
          1e-12);
      const auto estimate = estimate_pressure(sums, normal_over_ends, 1, size_ratio);
      EXPECT_NEAR(local_b(partition_slope(estimate.small, estimate.large, phi), phi), 0, 1e-12);
      EXPECT_NEAR(estimate.total(), stress.total.trace() / 3, 1e-13);
    }
}

/// Gravity 10 on a slope whose cosine is 0.8, with a component along z; density 3, friction 0.5.
const RunConstants run_of_spheres{1, 2, std::sqrt(20.0), -8, 3, 0.5, 4};

// z_S = 4, z_L = 16, f = 1; rho g cos(theta) (H - y) d_S^2 = 3 8 (20 - 5) = 360, m_S g = 3 pi/6 10.
TEST(StructureInSpace, DerivedQuantitiesAreThoseOfSpheres)
{
  const DerivedSettings settings{normal_over_ends, PartitionRule{}, 0};
  auto cells = named(derived_quantities(layer<3>(0.5), run_of_spheres, settings));
  EXPECT_NEAR(cells.at("nu"), 0.8, 1e-14);
  EXPECT_NEAR(cells.at("z_S"), 4, 1e-13);
  EXPECT_NEAR(cells.at("z_L"), 16, 1e-12);
  EXPECT_NEAR(cells.at("f_weight_S"), 1 / (5 * pi), 1e-15);
  EXPECT_NEAR(cells.at("f_depth_L"), 1 / 360.0, 1e-16);
  EXPECT_NEAR(cells.at("f_depth_neutral_S"), pi / 4, 1e-14);
  EXPECT_NEAR(cells.at("f_depth_neutral_L"), pi * 4 / 16, 1e-14);
  EXPECT_NEAR(cells.at("f_weight_neutral_S"), pi / 4 * 360 / (5 * pi), 1e-12);
  for (const std::string phase : {"", "_S", "_L"}) {
    EXPECT_NEAR(cells.at("error" + phase), 0, 1e-13);
    EXPECT_NEAR(cells.at("Pi" + phase + "[Pa]"), cells.at("P" + phase + "[Pa]"), 1e-12);
    EXPECT_FALSE(cells.contains("error" + phase + "_printed"));
  }
  EXPECT_NEAR(cells.at("s_Pi"), 1, 1e-13);
  EXPECT_NEAR(cells.at("B_yy"), 0, 1e-13);
  EXPECT_NEAR(cells.at("q/p_all"), 0, 1e-14);
  auto finer = run_of_spheres;
  finer.small_diameter = 0.5;
  cells = named(derived_quantities(layer<3>(0.5), finer, settings));
  EXPECT_NEAR(cells.at("f_depth_L"), 4 / 360.0, 1e-16);
  EXPECT_NEAR(cells.at("f_weight_S"), 8 / (5 * pi), 1e-14);
}

TEST(StructureInSpace, StressesAreThoseOfTheContactStressAtTheContactPoint)
{
  const auto scene = chain(0.7);
  const auto micro = structure_of(scene, slabs);
  PartialContactStress<3> stress(slabs, Assignment::contact_point);
  stress.add(scene.grains, scene.frame);
  ASSERT_EQ(micro.layers(), stress.layers());
  for (std::size_t n = 0; n < micro.layers(); ++n) {
    const auto sums = micro.mean(n);
    const auto expected = stress.mean(n).sums;
    EXPECT_TRUE(same(sums.of(PairType::SS).stress, expected.of(OwnSum::inside, 0)));
    EXPECT_TRUE(same(sums.of(PairType::LS).stress, expected.of(PairSum::whole, 0)));
    EXPECT_TRUE(same(sums.mixed_size, expected.of(PairSum::by_size, 0)));
    EXPECT_TRUE(same(sums.of(PairType::Lb).stress, expected.of(OwnSum::base, 1)));
  }
}

// A large sphere; its branch to a small one is (-2/3, 1/3, 2/3) 1.5: n = (-2, 1, 2)/3. The force on
// the small one is 3 n plus (2, 2, 1) tangentially.
TEST(StructureInSpace, EveryNumberStandsUnderItsColumn)
{
  Spheres scene;
  const auto base = scene.grain(Species::boundary, 1, {4, -1, 3});
  const auto large = scene.grain(Species::large, 1, {4, 1, 3});
  const auto small = scene.grain(Species::small, 0.5, {3, 1.5, 4});
  scene.contact(small, large, {-2 + 2, 1 + 2, 2 + 1});
  scene.contact(large, base, {0.5, 6, -0.25});
  const auto micro = structure_of(scene, one_slab);
  const auto columns = StructureByLayer<3>::columns();
  const auto bed = micro.bed_row();
  ASSERT_EQ(bed.size(), columns.size());
  std::map<std::string, double> cells;
  for (std::size_t c = 0; c < bed.size(); ++c) cells[columns[c]] = bed[c];
  EXPECT_NEAR(cells.at("volume_S[m^3]"), pi / 6, 1e-14);
  EXPECT_NEAR(cells.at("volume_L[m^3]"), 4 * pi / 3, 1e-13);
  EXPECT_EQ(cells.at("n_LS"), 1);
  EXPECT_NEAR(cells.at("sum_f_LS[N]"), std::sqrt(18), 1e-14);
  EXPECT_NEAR(cells.at("sum_fn_LS[N]"), 3, 1e-14);
  EXPECT_NEAR(cells.at("sum_ft/fn_LS"), 1, 1e-14);
  EXPECT_NEAR(cells.at("nn_LS_xz"), -4.0 / 9, 1e-15);
  EXPECT_NEAR(cells.at("nn_LS_zy"), 2.0 / 9, 1e-15);
  EXPECT_NEAR(cells.at("fn_nn_LS_zz[N]"), 4.0 / 3, 1e-14);
  EXPECT_NEAR(cells.at("ft_n_LS_yz[N]"), 4.0 / 3, 1e-14);
  EXPECT_NEAR(cells.at("ft_n_LS_zy[N]"), 1.0 / 3, 1e-14);
  EXPECT_NEAR(cells.at("M_yz[N m]"), 3 * 1, 1e-14);
  EXPECT_NEAR(cells.at("M_zy[N m]"), 3 * 0.5, 1e-14);
  EXPECT_NEAR(cells.at("Msize_zx[N m]"), 2.0 / 3 * 3 * -1, 1e-14);
  EXPECT_EQ(cells.at("base_fx[N]"), 0.5);
  EXPECT_EQ(cells.at("base_fy[N]"), 6);
  EXPECT_EQ(cells.at("base_fz[N]"), -0.25);
  EXPECT_NEAR(cells.at("yS[m]"), 1.5, 1e-15);
  EXPECT_FALSE(cells.contains("c2_LS"));
}

TEST(StructureInSpace, TheOrderOfTheGrainsInAContactDoesNotMatter)
{
  auto scene = chain(0.7), reversed = scene;
  auto& list = reversed.frame.contacts;
  for (std::size_t k = 1; k < list.size(); ++k) {
    std::swap(list.i[k], list.j[k]);
    list.force[k] *= -1;
    list.branch[k] *= -1;
  }
  const auto a = structure_of(scene, one_slab).mean().cells();
  const auto b = structure_of(reversed, one_slab).mean().cells();
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_NEAR(a[k].value, b[k].value, 1e-14) << a[k].column;
}

TEST(StructureInSpace, AContactSlidesWhicheverWayItsTangentialForcePoints)
{
  const auto pressed = [](const Vec3& force, double friction) {
    Spheres scene;
    scene.grain(Species::small, 1, {1, 1, 0});
    scene.grain(Species::small, 1, {3, 1, 0});
    scene.contact(1, 0, force);
    return structure_of(scene, one_slab, friction).mean().of(PairType::SS);
  };
  EXPECT_EQ(pressed({2, 0.6, -0.8}, 0.5).sliding, 1);
  EXPECT_EQ(pressed({2, 0, 1}, 0.5).sliding, 1);
  EXPECT_EQ(pressed({2, 0.6, 0.79}, 0.5).sliding, 0);
  EXPECT_NEAR(pressed({2, 0.6, -0.8}, 0.6).mobilised, 0.5, 1e-15);
}

// Forces 1, 4 and 6; a third of each is along z.
TEST(StructureInSpace, NormalForcesAreDistributedAsInTwoDimensions)
{
  Spheres scene;
  for (int g = 0; g < 4; ++g) scene.grain(Species::small, 1, {1.0 + 2 * g, 0.5, 3});
  for (const int g : {1, 2, 3}) scene.contact(g, g - 1, {g == 1 ? 1. : 2. * g, 0.1, 0.3});
  MeanNormalForce<3> mean(slabs);
  mean.add(scene.grains, scene.frame);
  EXPECT_NEAR(mean.of(0, PairType::SS), 11.0 / 3, 1e-14);
  ForceDistribution<3> forces(slabs, mean, ForceUnit::layer, 0.1);
  forces.add(scene.grains, scene.frame);
  const auto rows = forces.rows(0);
  EXPECT_EQ(rows[2][2], 1);   // n_SS: 1 of 11/3 is 0.27
  EXPECT_EQ(rows[10][2], 1);  // 1.09
  EXPECT_EQ(rows[16][2], 1);  // 1.64
}

TEST(StructureInSpace, TablesOfSumsAreReadAgainAndPooled)
{
  Table table;
  table.name = "micro.tsv";
  table.header = {{"dimension", "3"}};
  std::vector<std::string> columns;
  for (const auto& cell : StructureSums<3>{}.cells()) columns.push_back(cell.column);
  for (const char* name : {"yL[m]", "yS[m]", "height[m]"}) columns.emplace_back(name);
  table.columns = with_key_columns(3, columns);
  const auto sums = structure_of(chain(0.7), one_slab).mean();
  for (const double frames : {1., 3.}) {
    auto values = values_of((sums * frames).cells());
    values.insert(values.end(), 3, std::nan(""));  // heights of the whole bed
    table.rows.push_back(with_key({frames, frames + 1, 0, 20, frames, 1400}, values));
  }
  const auto rows = read_sums_rows<3>(table);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(values_of(rows[0].sums.cells()), values_of(sums.cells()));
  const auto all = pooled(rows, Pool::composition);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].frames, 4);
  const auto mean = values_of(all[0].sums.cells()), expected = values_of((sums * 2.5).cells());
  for (std::size_t k = 0; k < mean.size(); ++k) EXPECT_NEAR(mean[k], expected[k], 1e-12);
}

}  // namespace
}  // namespace grseg
