// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/derived_quantities.hpp"

#include "tests/analysis/micro/sums_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Gravity 10 on a slope whose cosine is 0.8, grains of density 3, friction 0.5.
const RunConstants constants{1, 2, 6, -8, 3, 0.5};
const DerivedSettings over_ends{{ContactForce::normal, ForceAverage::ends}, PartitionRule{}, 0};

double value(const std::vector<Cell>& cells, const std::string& name)
{
  for (const auto& cell : cells)
    if (cell.column == name) return cell.value;
  ADD_FAILURE() << "no column " << name;
  return nan;
}

TEST(DerivedQuantities, NeutralContactsDivideIntoTheRatiosOfTheirSizes)
{
  const auto cells = derived_quantities(layer(0.5), constants, over_ends);
  EXPECT_NEAR(value(cells, "nu"), 0.8, 1e-14);
  EXPECT_NEAR(value(cells, "z_S"), 4, 1e-13);
  EXPECT_NEAR(value(cells, "z_L"), 8, 1e-13);
  EXPECT_NEAR(value(cells, "z_SL"), 4.0 / 3, 1e-13);  // x_L = 1/3 of the ends are on large grains
  EXPECT_NEAR(value(cells, "z_LS"), 16.0 / 3, 1e-13);
  EXPECT_NEAR(value(cells, "z_LL"), 8.0 / 3, 1e-13);
  EXPECT_NEAR(value(cells, "z_S/z_L"), 0.5, 1e-14);
  EXPECT_NEAR(value(cells, "f_S/f_L"), 1, 1e-14);
  EXPECT_NEAR(value(cells, "s_Pi"), 1, 1e-13);
  EXPECT_NEAR(value(cells, "B_Pi"), 0, 1e-13);
  EXPECT_NEAR(value(cells, "B_P"), 0, 1e-13);
  EXPECT_NEAR(value(cells, "B_yy"), 0, 1e-13);
  EXPECT_NEAR(value(cells, "mixed_share"), value(cells, "neutral_share"), 1e-14);
}

TEST(DerivedQuantities, ThePrintedPrefactorErrsByTheWholePressure)
{
  const auto cells = derived_quantities(layer(0.3), constants, over_ends);
  for (const std::string phase : {"", "_S", "_L"}) {
    EXPECT_NEAR(value(cells, "error" + phase), 0, 1e-13);
    EXPECT_NEAR(value(cells, "error" + phase + "_printed"), 1, 1e-13);
    EXPECT_NEAR(value(cells, "Pi" + phase + "[N/m]"), value(cells, "P" + phase + "[N/m]"), 1e-12);
  }
}

// rho g cos(theta) (H - y) d_S = 3 8 (20 - 5) 1 = 360, m_S g = 3 (pi/4) 10.
TEST(DerivedQuantities, ForcesAreMeasuredByTheWeightOfAGrainAndByThePressureAtTheirHeight)
{
  auto cells = derived_quantities(layer(0.5), constants, over_ends);
  const double weight = 7.5 * std::numbers::pi;
  EXPECT_NEAR(value(cells, "f_weight_S"), 1 / weight, 1e-15);
  EXPECT_NEAR(value(cells, "f_depth_L"), 1 / 360.0, 1e-16);
  EXPECT_NEAR(value(cells, "f_depth_neutral_S"), std::numbers::pi / 4, 1e-14);
  EXPECT_NEAR(value(cells, "f_depth_neutral_L"), std::numbers::pi * 2 / 8, 1e-14);
  EXPECT_NEAR(value(cells, "f_weight_neutral_S"), std::numbers::pi / 4 * 360 / weight, 1e-12);
  DerivedSettings deeper = over_ends;
  deeper.depth = 25;
  cells = derived_quantities(layer(0.5), constants, deeper);
  EXPECT_NEAR(value(cells, "f_depth_L"), 1 / 480.0, 1e-16);
  auto finer = constants;
  finer.small_diameter = 0.5;
  cells = derived_quantities(layer(0.5), finer, over_ends);
  EXPECT_NEAR(value(cells, "f_depth_L"), 1 / 180.0, 1e-16);
  EXPECT_NEAR(value(cells, "f_weight_S"), 4 / weight, 1e-15);
}

TEST(DerivedQuantities, OfTheWholeBedThePressureIsTakenAtTheCentresOfMass)
{
  auto bed = layer(0.5);
  bed.bottom = bed.top = nan;
  bed.heights = {12, 8, 20};
  const auto cells = derived_quantities(bed, constants, over_ends);
  EXPECT_NEAR(value(cells, "yL/H"), 0.6, 1e-15);
  EXPECT_NEAR(value(cells, "f_depth_L"), 1 / (24 * 8.0), 1e-16);
  EXPECT_NEAR(value(cells, "f_depth_S"), 1 / (24 * 12.0), 1e-16);
}

TEST(DerivedQuantities, WithoutDensityForcesHaveNoScaleAndWithoutFrictionContactsNoLimit)
{
  auto unknown = constants;
  unknown.density = unknown.mean_density = unknown.friction = nan;
  const auto cells = derived_quantities(layer(0.5), unknown, over_ends);
  EXPECT_TRUE(std::isnan(value(cells, "f_weight_S")));
  EXPECT_TRUE(std::isnan(value(cells, "f_depth_S")));
  EXPECT_TRUE(std::isnan(value(cells, "mobilised_SS")));
  EXPECT_NEAR(value(cells, "f_S[N]"), 1, 1e-15);
}

TEST(DerivedQuantities, FrictionAndStrengthAreSharesOfTheContacts)
{
  auto row = layer(0.5);
  auto& mixed = row.sums.pair[static_cast<std::size_t>(PairType::LS)];
  auto& large = row.sums.pair[static_cast<std::size_t>(PairType::LL)];
  mixed.mobilised = 0.2 * mixed.contacts;
  mixed.sliding = 0.25 * mixed.contacts;
  mixed.strong = 0.5 * mixed.contacts;
  large.strong = large.contacts;
  const auto cells = derived_quantities(row, constants, over_ends);
  EXPECT_NEAR(value(cells, "mobilised_LS"), 0.4, 1e-15);
  EXPECT_NEAR(value(cells, "sliding_LS"), 0.25, 1e-15);
  EXPECT_NEAR(value(cells, "sliding_all"), 0.25 * 4 / 9, 1e-15);
  EXPECT_NEAR(value(cells, "strong_LS"), 0.5, 1e-15);
  // Contacts SS : LS : LL = 4 : 4 : 1, of which 0, 2 and 1 are strong.
  EXPECT_NEAR(value(cells, "share_of_strong_LS"), 2.0 / 3, 1e-14);
  EXPECT_NEAR(value(cells, "share_of_weak_LS"), 2.0 / 6, 1e-14);
  EXPECT_NEAR(value(cells, "strong_all"), 3.0 / 9, 1e-14);
}

}  // namespace
}  // namespace grseg
