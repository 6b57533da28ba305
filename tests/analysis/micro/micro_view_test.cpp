// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/micro_view.hpp"

#include "formats/core/errors.hpp"
#include "tests/analysis/neutral_contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Gravity 10 on a slope whose cosine is 0.8, grains of density 3, friction 0.5.
const MicroScale scale{1, 2, 6, -8, 3, 0.5};
const ViewSettings over_ends{{ContactForce::normal, ForceAverage::ends}, PartitionRule{}, 0};

/// A layer of neutral contacts, from 4 to 6 in a bed of height 20.
MicroRow layer(double phi_large)
{
  return {.begin = 0,
          .end = 1,
          .bottom = 4,
          .top = 6,
          .frames = 10,
          .volume = 125,
          .sums = neutral_contacts(phi_large, 2),
          .heights = {nan, nan, nan},
          .bed_height = 20};
}

double value(const std::vector<Cell>& cells, const std::string& name)
{
  for (const auto& cell : cells)
    if (cell.name == name) return cell.value;
  ADD_FAILURE() << "no column " << name;
  return nan;
}

TEST(MicroView, NeutralContactsDivideIntoTheRatiosOfTheirSizes)
{
  const auto cells = derived(layer(0.5), scale, over_ends);
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

TEST(MicroView, ThePrintedPrefactorErrsByTheWholePressure)
{
  const auto cells = derived(layer(0.3), scale, over_ends);
  for (const std::string phase : {"", "_S", "_L"}) {
    EXPECT_NEAR(value(cells, "error" + phase), 0, 1e-13);
    EXPECT_NEAR(value(cells, "error" + phase + "_printed"), 1, 1e-13);
    EXPECT_NEAR(value(cells, "Pi" + phase + "[N/m]"), value(cells, "P" + phase + "[N/m]"), 1e-12);
  }
}

// rho g cos(theta) (H - y) d_S = 3 8 (20 - 5) 1 = 360, m_S g = 3 (pi/4) 10.
TEST(MicroView, ForcesAreMeasuredByTheWeightOfAGrainAndByThePressureAtTheirHeight)
{
  auto cells = derived(layer(0.5), scale, over_ends);
  const double weight = 7.5 * std::numbers::pi;
  EXPECT_NEAR(value(cells, "f_weight_S"), 1 / weight, 1e-15);
  EXPECT_NEAR(value(cells, "f_depth_L"), 1 / 360.0, 1e-16);
  EXPECT_NEAR(value(cells, "f_depth_neutral_S"), std::numbers::pi / 4, 1e-14);
  EXPECT_NEAR(value(cells, "f_depth_neutral_L"), std::numbers::pi * 2 / 8, 1e-14);
  EXPECT_NEAR(value(cells, "f_weight_neutral_S"), std::numbers::pi / 4 * 360 / weight, 1e-12);
  ViewSettings deeper = over_ends;
  deeper.depth = 25;
  cells = derived(layer(0.5), scale, deeper);
  EXPECT_NEAR(value(cells, "f_depth_L"), 1 / 480.0, 1e-16);
  auto finer = scale;
  finer.small_diameter = 0.5;
  cells = derived(layer(0.5), finer, over_ends);
  EXPECT_NEAR(value(cells, "f_depth_L"), 1 / 180.0, 1e-16);
  EXPECT_NEAR(value(cells, "f_weight_S"), 4 / weight, 1e-15);
}

TEST(MicroView, OfTheWholeBedThePressureIsTakenAtTheCentresOfMass)
{
  auto bed = layer(0.5);
  bed.bottom = bed.top = nan;
  bed.heights = {12, 8, 20};
  const auto cells = derived(bed, scale, over_ends);
  EXPECT_NEAR(value(cells, "yL/H"), 0.6, 1e-15);
  EXPECT_NEAR(value(cells, "f_depth_L"), 1 / (24 * 8.0), 1e-16);
  EXPECT_NEAR(value(cells, "f_depth_S"), 1 / (24 * 12.0), 1e-16);
}

TEST(MicroView, WithoutDensityForcesHaveNoScaleAndWithoutFrictionNoLimit)
{
  auto unknown = scale;
  unknown.density = unknown.friction = nan;
  const auto cells = derived(layer(0.5), unknown, over_ends);
  EXPECT_TRUE(std::isnan(value(cells, "f_weight_S")));
  EXPECT_TRUE(std::isnan(value(cells, "f_depth_S")));
  EXPECT_TRUE(std::isnan(value(cells, "mobilised_SS")));
  EXPECT_NEAR(value(cells, "f_S[N]"), 1, 1e-15);
}

TEST(MicroView, FrictionAndStrengthAreSharesOfTheContacts)
{
  auto row = layer(0.5);
  auto& mixed = row.sums.pair[static_cast<std::size_t>(PairType::LS)];
  auto& large = row.sums.pair[static_cast<std::size_t>(PairType::LL)];
  mixed.mobilised = 0.2 * mixed.contacts;
  mixed.sliding = 0.25 * mixed.contacts;
  mixed.strong = 0.5 * mixed.contacts;
  large.strong = large.contacts;
  const auto cells = derived(row, scale, over_ends);
  EXPECT_NEAR(value(cells, "mobilised_LS"), 0.4, 1e-15);
  EXPECT_NEAR(value(cells, "sliding_LS"), 0.25, 1e-15);
  EXPECT_NEAR(value(cells, "sliding_all"), 0.25 * 4 / 9, 1e-15);
  EXPECT_NEAR(value(cells, "strong_LS"), 0.5, 1e-15);
  // SS : LS : LL = 4 : 4 : 1, of which 0, 2 and 1 are strong.
  EXPECT_NEAR(value(cells, "share_of_strong_LS"), 2.0 / 3, 1e-14);
  EXPECT_NEAR(value(cells, "share_of_weak_LS"), 2.0 / 6, 1e-14);
  EXPECT_NEAR(value(cells, "strong_all"), 3.0 / 9, 1e-14);
}

Table table_of(const std::vector<MicroRow>& rows)
{
  Table table;
  table.name = "micro.tsv";
  table.columns = {"t0[s]", "t1[s]", "y0[m]", "y1[m]", "frames", "V[m^2]"};
  for (const auto& name : MicroSums::columns()) table.columns.push_back(name);
  for (const char* name : {"yL[m]", "yS[m]", "height[m]"}) table.columns.emplace_back(name);
  for (const auto& row : rows) {
    std::vector<double> cells{row.begin, row.end, row.bottom, row.top, row.frames, row.volume};
    for (const double number : row.sums.numbers()) cells.push_back(number);
    for (const double h : {row.heights.large, row.heights.small, row.heights.bed})
      cells.push_back(h);
    table.rows.push_back(cells);
  }
  return table;
}

MicroRow bed_of_height(double height, double begin)
{
  auto bed = layer(0.5);
  bed.begin = begin;
  bed.bottom = bed.top = nan;
  bed.heights = {1, 2, height};
  return bed;
}

TEST(MicroTable, LayersFindTheHeightOfTheBedInTheirOwnWindow)
{
  auto later = layer(0.5);
  later.begin = 1;
  const auto rows =
      read_micro_rows(table_of({layer(0.5), bed_of_height(20, 0), later, bed_of_height(22, 1)}));
  EXPECT_EQ(rows[0].bed_height, 20);
  EXPECT_EQ(rows[2].bed_height, 22);
  EXPECT_EQ(rows[2].sums.numbers(), later.sums.numbers());
  EXPECT_TRUE(rows[3].is_bed());
  EXPECT_FALSE(rows[2].is_bed());
}

TEST(MicroTable, AMissingColumnIsNamed)
{
  auto table = table_of({layer(0.5)});
  table.columns[table.column("c2_LS")] = "c3_LS";
  try {
    read_micro_rows(table);
    FAIL();
  } catch (const FormatError& error) {
    EXPECT_STREQ(error.what(),
                 "micro.tsv: there is no column 'c2_LS'; --derived needs a table of grseg-micro");
  }
}

TEST(MicroTable, ANumberThatIsNoneIsRefusedUnlessItConcernsUnknownFriction)
{
  auto table = table_of({layer(0.5)});
  table.rows[0][table.column("n_slide_SS")] = nan;
  EXPECT_EQ(read_micro_rows(table).size(), 1u);
  table.rows[0][table.column("ends_L")] = nan;
  EXPECT_THROW(read_micro_rows(table), FormatError);
}

TEST(MicroTable, WindowsArePooledAsMeansWeightedByTheirFrames)
{
  auto later = layer(0.5);
  later.begin = 1;
  later.end = 2;
  later.frames = 30;
  later.sums = layer(0.5).sums * 3;
  const auto rows = pooled({layer(0.5), later, bed_of_height(20, 0)}, Pool::windows);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].frames, 40);
  EXPECT_EQ(rows[0].begin, 0);
  EXPECT_EQ(rows[0].end, 2);
  EXPECT_EQ(rows[0].bottom, 4);
  EXPECT_EQ(rows[0].volume, 125);
  EXPECT_NEAR(rows[0].sums.of(Species::small).ends, 2.5 * layer(0.5).sums.of(Species::small).ends,
              1e-11);
  EXPECT_NEAR(rows[0].sums.coordination(Species::small), 4, 1e-13);
  EXPECT_TRUE(rows[1].is_bed());
}

TEST(MicroTable, LayersOfLikeCompositionArePooledAndTheBedLeftOut)
{
  auto empty = layer(0.5);
  empty.sums = {};
  const auto rows = pooled(
      {layer(0.51), layer(0.35), layer(0.59), layer(1), layer(0.95), empty, bed_of_height(20, 0)},
      Pool::composition);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_NEAR(rows[0].sums.phi_large(), 0.35, 1e-14);
  EXPECT_NEAR(rows[1].sums.phi_large(), 0.55, 1e-14);
  EXPECT_NEAR(rows[2].sums.phi_large(), 0.975, 1e-14);
}

TEST(MicroTable, RowsAreChosenByWindowAndHeightButTheBedByWindowAlone)
{
  auto later = layer(0.5);
  later.begin = 1;
  later.end = 2;
  auto higher = layer(0.5);
  higher.bottom = 6;
  higher.top = 8;
  const std::vector<MicroRow> rows{layer(0.5), later, higher, bed_of_height(20, 0)};
  EXPECT_EQ(filtered(rows, {.end = 1}).size(), 3u);
  EXPECT_EQ(filtered(rows, {.lowest = 4, .highest = 6}).size(), 3u);
  EXPECT_EQ(filtered(rows, {.begin = 1, .highest = 6}).size(), 1u);
}

}  // namespace
}  // namespace grseg
