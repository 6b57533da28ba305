// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/partition_data.hpp"

#include "tests/analysis/explore/unpacked.hpp"
#include "tests/analysis/synthetic_sums.hpp"
#include "tests/folder.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

using synthetic::neutral_sums;

/// Value at q of the polynomial through the nodes, by Lagrange's formula.
double interpolated(const std::vector<double>& nodes, const std::vector<double>& values, double q)
{
  double sum = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    double product = values[k];
    for (std::size_t m = 0; m < nodes.size(); ++m)
      if (m != k) product *= (q - nodes[m]) / (nodes[k] - nodes[m]);
    sum += product;
  }
  return sum;
}

double share(double ratio, double q)
{
  return 1 / (1 + std::pow(ratio, -q));
}

TEST(PowerNodes, BetweenThemAPolynomialHasTheShare)
{
  const auto nodes = power_nodes();
  EXPECT_EQ(nodes.front(), 0);
  EXPECT_EQ(nodes.back(), 4);
  for (const auto& [ratio, tolerance] :
       {std::pair{1.5, 1e-12}, {2.0, 1e-10}, {2.4, 1e-9}, {3.0, 1e-7}}) {
    std::vector<double> values;
    values.reserve(nodes.size());
    for (const double node : nodes) values.push_back(share(ratio, node));
    for (double q = 0; q <= 4; q += 0.0371)
      EXPECT_NEAR(interpolated(nodes, values, q), share(ratio, q), tolerance) << ratio << ", " << q;
  }
}

/// Table of neutral contacts with three compositions, in `windows` windows.
Table neutral_table(int windows)
{
  std::vector<synthetic::TableRow> rows;
  for (int window = 0; window < windows; ++window)
    for (const double phi : {0.3, 0.5, 0.7})
      rows.push_back({1.0 * window, window + 1.0, 10, neutral_sums(phi, 2)});
  return synthetic::stress_table(rows);
}

PartitionSettings settings_of(const char* rules)
{
  PartitionSettings settings;
  settings.rules = parse_rules({rules});
  return settings;
}

TEST(PartitionData, StressesAreThoseOfTheSums)
{
  BinaryArrays arrays;
  partition_data({{neutral_table(1)}, {}}, settings_of("size"), arrays);
  const auto of = [&](const char* name) { return unpacked::array<double>(arrays, name, "f64"); };
  const auto phi = of("phi_large");
  ASSERT_EQ(phi.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto sums = neutral_sums(phi[k], 2);
    const auto yy = [&](const Tensor2& sum) { return sum(1, 1) / sums.volume; };
    const double small = yy(sums.of(OwnSum::inside, 0)), large = yy(sums.of(OwnSum::inside, 1)),
                 mixed = yy(sums.of(PairSum::whole, 0));
    EXPECT_NEAR(of("none_large")[k], large, 1e-14);
    EXPECT_NEAR(of("none_small")[k], small + mixed, 1e-14);
    EXPECT_NEAR(of("all_large")[k], large + mixed, 1e-14);
    EXPECT_NEAR(of("all_small")[k], small, 1e-14);
    EXPECT_NEAR(of("size_large")[k], large + 2 * mixed / 3, 1e-14);
    EXPECT_NEAR(of("drop_small")[k], small, 1e-14);
    EXPECT_NEAR(of("drop_total")[k], small + mixed + large, 1e-14);
    EXPECT_NEAR(of("bottom")[k], 0.0202 * static_cast<double>(k), 1e-15);
  }
}

TEST(PartitionData, LayersAreMeansWeightedByFrames)
{
  const double phi = 0.4;
  auto strong = neutral_sums(phi, 2);
  for (std::size_t k : {0u, 1u}) strong.of(OwnSum::inside, k) *= 4;
  BinaryArrays arrays;
  const auto table =
      synthetic::stress_table({{0, 1, 30, neutral_sums(phi, 2)}, {1, 2, 10, strong}});
  partition_data({{table}, {}}, settings_of("size"), arrays);
  const auto sums = neutral_sums(phi, 2);
  const double once = sums.of(OwnSum::inside, 1)(1, 1) / sums.volume;
  const auto layer = unpacked::array<double>(arrays, "layer_none_large", "f64");
  ASSERT_EQ(layer.size(), 1u);
  EXPECT_NEAR(layer[0], (30 * once + 10 * 4 * once) / 40, 1e-15);
  EXPECT_EQ(unpacked::array<double>(arrays, "layer_frames", "f64")[0], 40);
}

// The upper layer is in the second window only, a quarter of all frames.
TEST(PartitionData, ALayerThatAWindowLacksIsEmptyThere)
{
  BinaryArrays arrays;
  const auto table = synthetic::stress_table({{0, 1, 30, neutral_sums(0.4, 2)},
                                              {1, 2, 10, neutral_sums(0.4, 2)},
                                              {1, 2, 10, neutral_sums(0.4, 2)}});
  partition_data({{table}, {}}, settings_of("size"), arrays);
  const auto layer = unpacked::array<double>(arrays, "layer_none_large", "f64");
  ASSERT_EQ(layer.size(), 2u);
  EXPECT_NEAR(layer[1], layer[0] / 4, 1e-15);
  EXPECT_EQ(unpacked::array<double>(arrays, "layer_frames", "f64")[1], 10);
}

TEST(PartitionData, ByNeutralContactsBIsZeroBySizeAndAtTwoThirds)
{
  BinaryArrays arrays;
  const auto data = partition_data({{neutral_table(2)}, {}}, settings_of("size,half"), arrays);
  EXPECT_NEAR(data["rules"][0]["B"][0], 0, 1e-12);
  EXPECT_EQ(data["two"], true);
  EXPECT_NEAR(data["scan"]["p_zero"][0], 2.0 / 3, 1e-12);
  EXPECT_EQ(data["rules"][1]["name"], "half");
  EXPECT_LT(data["rules"][1]["B"][0], -0.2);
  EXPECT_EQ(data["scan"]["p"].size(), 101u);
  EXPECT_NEAR(data["scan"]["B"][50][0], data["rules"][1]["B"][0], 1e-12);
  EXPECT_EQ(data["size_ratio"], 2);
  EXPECT_EQ(data["power_nodes"].size(), 0u) << "there are no sums by power:Q";
}

TEST(PartitionData, EachLayerHasTheIntervalThatItHasAlone)
{
  std::vector<synthetic::TableRow> all, alone;
  for (int window = 0; window < 20; ++window)
    for (const double phi : {0.3, 0.5}) {
      auto sums = neutral_sums(phi, 2);
      sums.of(OwnSum::inside, 1) *= 1 + 0.1 * std::sin(window * window);
      all.push_back({1.0 * window, window + 1.0, 10, sums});
      if (phi == 0.3) alone.push_back(all.back());
    }
  auto settings = settings_of("size");
  settings.fit.thickness = Thickness::kept;  // a layer alone has no neighbours
  BinaryArrays arrays, of_alone;
  const auto layers = partition_data({{synthetic::stress_table(all)}, {}}, settings, arrays);
  const auto one = partition_data({{synthetic::stress_table(alone)}, {}}, settings, of_alone);
  ASSERT_EQ(layers["by_layer"]["layers"].size(), 2u);
  const auto& rows = layers["by_layer"]["layers"][0]["B"];
  for (const std::size_t k : {0u, 10u, 20u}) {
    EXPECT_NEAR(layers["by_layer"]["p"][k], 0.05 * static_cast<double>(k), 1e-12);
    for (const std::size_t end : {0u, 1u, 2u})
      EXPECT_NEAR(rows[k][end], one["scan"]["B"][5 * k][end], 1e-12);
  }
  EXPECT_LT(rows[10][1], rows[10][0]);
}

TEST(PartitionData, SaysWhatItsIntervalsAreOverAndWhyTheyMayBeTooNarrow)
{
  BinaryArrays arrays;
  const auto data = partition_data({{neutral_table(2)}, {}}, settings_of("size"), arrays);
  EXPECT_EQ(data["over"], "windows");
  EXPECT_EQ(data["over_words"].get<std::string>().rfind("B of these runs, if they had lasted", 0),
            0u);
  EXPECT_EQ(data["settings"]["times"], "0 to 2 s");
  const std::string few =
      "one window is one observation, too few for an interval; make more with a shorter --window";
  EXPECT_EQ(data["rules"][0]["doubt"], few) << "nothing moves between the two windows";
  EXPECT_EQ(data["scan"]["doubts"][50], few);
}

TEST(PartitionData, SaysWhatIsMissingWhereNoLayerHoldsBothSpecies)
{
  const auto alone = synthetic::separate_sums(0, synthetic::any_tensor(), Tensor2::Zero());
  BinaryArrays arrays;
  EXPECT_EQ(
      complaint_of<RunError>([&] {
        partition_data({{synthetic::stress_table({{0, 1, 10, alone}})}, {}}, settings_of("size"),
                       arrays);
      }),
      "no usable points: 1 rows, 1 without large grains; B needs layers that contain both species");
}

}  // namespace
}  // namespace grseg
