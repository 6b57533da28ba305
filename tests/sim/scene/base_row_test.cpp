// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/base_row.hpp"

#include "sim/scene/deposition.hpp"
#include "sim/scene/geometry.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace grseg {
namespace {

using Words = std::vector<std::string>;

Scene scene_from(Words words)
{
  for (const auto* word : {"--accuracy", "draft"}) words.emplace_back(word);
  return small_chute::paper_scene(words);
}

/// Base for the command-line words; d_S is 5 mm and d_L 10 mm.
Boundaries base_of(const Words& words)
{
  const auto scene = scene_from(words);
  return scene.geometry->boundaries(scene);
}

std::vector<double> tops_of(const Boundaries& base)
{
  std::vector<double> tops;
  for (std::size_t k = 0; k < base.position.size(); ++k)
    tops.push_back(base.position[k].y() + base.radius[k]);
  return tops;
}

/// Distances of neighbouring beads along x, including the one across the ends of the cell, m.
std::vector<double> spacings_of(const Boundaries& base, double length)
{
  std::vector<double> spacings;
  for (std::size_t k = 0; k < base.position.size(); ++k) {
    const bool last = k + 1 == base.position.size();
    const double next = last ? base.position[0].x() + length : base.position[k + 1].x();
    spacings.push_back(next - base.position[k].x());
  }
  return spacings;
}

struct Range {
  double least, most, mean;
};

Range range_of(const std::vector<double>& values)
{
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {*least, *most,
          std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size())};
}

std::string complaint_about(const Words& words)
{
  try {
    scene_from(words);
  } catch (const SceneError& error) {
    return error.key;
  }
  return "";
}

TEST(BaseRow, IsByDefaultARowOfTouchingLargeGrainsUnderYZero)
{
  const auto base = base_of({"--length", "35dL"});
  ASSERT_EQ(base.position.size(), 35U);
  for (std::size_t k = 0; k < 35; ++k) {
    EXPECT_EQ(base.radius[k], 0.005);
    EXPECT_NEAR(base.position[k].x(), 0.01 * (static_cast<double>(k) + 0.5), 1e-15);
    EXPECT_EQ(base.position[k].y(), -0.005);
  }
}

TEST(BaseRow, HasItsHighestTopAtYZeroAndItsLowestBelowByTheHeightSpread)
{
  for (const auto& more : {Words{}, Words{"--base-diameter", "0.7dL", "--base-diameter-spread",
                                          "0.3", "--base-spacing-spread", "0.4"}}) {
    auto words = more;
    words.insert(words.end(), {"--base-height-spread", "0.5dS"});
    const auto tops = range_of(tops_of(base_of(words)));
    EXPECT_NEAR(tops.most, 0, 1e-15);
    EXPECT_NEAR(tops.least, -0.0025, 1e-15);
    EXPECT_NEAR(tops.mean, -0.00125, 1e-15);
    words.insert(words.end(), {"--origin", "centre"});
    const auto scene = scene_from(words);
    const auto base = scene.geometry->boundaries(scene);
    EXPECT_NEAR(range_of(tops_of(base)).most, scene.base_diameter / 2, 1e-15);
    EXPECT_EQ(base.top, scene.base_diameter / 2);
  }
}

TEST(BaseRow, HasDiametersOfTheAskedMeanAndRangeWhoseTopsAreLevel)
{
  const auto base = base_of({"--base-diameter", "0.8dL", "--base-diameter-spread", "0.5"});
  const auto radius = range_of(base.radius);
  EXPECT_NEAR(radius.mean, 0.004, 1e-15);
  EXPECT_NEAR(radius.most - radius.least, 0.5 * 0.004, 1e-15);
  const auto tops = range_of(tops_of(base));
  EXPECT_NEAR(tops.least, 0, 1e-15);
  EXPECT_NEAR(tops.most, 0, 1e-15);
}

TEST(BaseRow, HasTheAskedSpacingWhereItDividesTheCellAndOtherwiseTheNextWiderThatDoes)
{
  const auto exact = spacings_of(base_of({"--length", "28dL", "--base-spacing", "1.4dL"}), 0.28);
  EXPECT_EQ(exact.size(), 20U);
  EXPECT_NEAR(range_of(exact).least, 0.014, 1e-14);
  EXPECT_NEAR(range_of(exact).most, 0.014, 1e-14);
  const Words other{"--length", "27.9dL", "--base-spacing", "1.2dL"};
  const auto wider = spacings_of(base_of(other), 0.279);
  EXPECT_EQ(wider.size(), 23U);
  EXPECT_NEAR(range_of(wider).least, 0.279 / 23, 1e-14);
  EXPECT_NEAR(range_of(wider).most, 0.279 / 23, 1e-14);
  EXPECT_NEAR(scene_from(other).base_spacing, 0.279 / 23, 1e-14) << "what the run file records";
}

TEST(BaseRow, HasRandomSpacingsOfTheAskedRangeThatStillFillTheCell)
{
  const auto spacings =
      spacings_of(base_of({"--length", "35dL", "--base-spacing-spread", "0.6"}), 0.35);
  const auto range = range_of(spacings);
  EXPECT_EQ(spacings.size(), 35U);
  EXPECT_NEAR(range.mean, 0.01, 1e-15);
  EXPECT_NEAR(range.least, 0.007, 1e-14);
  EXPECT_NEAR(range.most, 0.013, 1e-14);
}

TEST(BaseRow, IsTheSameForTheSameSeedAndAnotherForAnother)
{
  const auto base = [](const char* seed) {
    return base_of({"--seed", seed, "--base-height-spread", "0.5dS", "--base-spacing-spread", "0.2",
                    "--base-diameter-spread", "0.2"});
  };
  const auto one = base("1"), again = base("1"), other = base("2");
  EXPECT_EQ(one.position, again.position);
  EXPECT_EQ(one.radius, again.radius);
  EXPECT_NE(one.radius, other.radius);
  EXPECT_NE(spacings_of(one, 0.35), spacings_of(other, 0.35));
  EXPECT_NE(tops_of(one), tops_of(other));
}

TEST(BaseRow, LeavesTheGrainsThatFallOnItAsTheyAre)
{
  // The bed is so large that its first filling has the required height: a second filling would have
  // other grains.
  const Words size{"--depth", "24dS", "--length", "24dL"};
  auto irregular = size;
  irregular.insert(irregular.end(), {"--base-height-spread", "0.2dS"});
  const auto a = deposit<2>(scene_from(size)), b = deposit<2>(scene_from(irregular));
  EXPECT_EQ(a.world().grains.radius, b.world().grains.radius);
}

/// Number of mobile grains below the lowest bead's centre after one second of flow.
std::size_t fallen(const Words& words)
{
  auto all = words;
  all.insert(all.end(), {"--depth", "16dS", "--phi-large", "0.3", "--slope", "24"});
  const auto scene = scene_from(all);
  auto simulation = release(deposit<2>(scene), scene);
  while (simulation.time() < 1) simulation.advance();
  const auto& fixed = simulation.world().grains.fixed;
  double lowest = 0;
  for (std::size_t g = 0; g < fixed.size(); ++g)
    if (fixed[g]) lowest = std::min(lowest, simulation.position(g).y());
  std::size_t count = 0;
  for (std::size_t g = 0; g < fixed.size(); ++g)
    count += !fixed[g] && simulation.position(g).y() < lowest ? 1 : 0;
  return count;
}

TEST(BaseRow, HoldsItsGrainsInAFlowUpToTheWidestGapsThatItsKeysMayHave)
{
  const std::vector<Words> bases{
      {"--length", "20dL", "--base-height-spread", "1dL"},
      {"--length", "20.02dL", "--base-spacing", "1.43dL"},
      {"--length", "20dL", "--base-diameter-spread", "0.8"},
      {"--length", "20dL", "--base-spacing-spread", "0.8"},
      {"--length", "20dL", "--base-diameter", "0.5dL", "--base-height-spread", "0.3dL",
       "--base-diameter-spread", "0.4", "--base-spacing-spread", "0.3"},
      {"--length", "20dL", "--base-spacing-spread", "0.4", "--lateral", "walls"}};
  for (const auto& words : bases) {
    EXPECT_EQ(fallen(words), 0U) << words.back();
    const auto scene = scene_from(words);
    EXPECT_GT(widest_gap(scene), 0) << "the base has no gap to fall through";
  }
}

TEST(BaseRow, OfSpheresIsLoweredOverTheWholeRange)
{
  const Words spheres{"--dimension", "3", "--length", "20dS", "--width", "12dS"};
  auto lowered = spheres;
  lowered.insert(lowered.end(), {"--base-height-spread", "1dS"});
  const auto tops = range_of(tops_of(base_of(lowered)));
  EXPECT_NEAR(tops.most, 0, 1e-15);
  EXPECT_NEAR(tops.least, -0.005, 1e-15);
  EXPECT_NEAR(tops.mean, -0.0025, 1e-15);
  const auto regular = base_of(spheres), base = base_of(lowered);
  ASSERT_EQ(base.position.size(), regular.position.size());
  for (std::size_t k = 0; k < base.position.size(); ++k)
    EXPECT_EQ(base.position[k].z(), regular.position[k].z());
}

// Three beads that touched have a hole of 2/sqrt(3) sqrt(1 + h^2) - 1 d_L if their heights differ by h
// d_L; the smallest grain retains 0.9 x 0.48 d_L, up to h = 0.7335.
TEST(BaseRow, OfSpheresIsRefusedWhereGrainsCouldFallThrough)
{
  const Words spheres{"--dimension", "3", "--length", "20dS", "--width", "12dS"};
  for (const auto& [height, complaint] :
       {std::pair{"0.73dL", ""}, {"0.74dL", "base-height-spread"}}) {
    auto words = spheres;
    words.insert(words.end(), {"--base-height-spread", height});
    EXPECT_EQ(complaint_about(words), complaint) << height;
  }
}

TEST(BaseRow, ThatGrainsCouldFallThroughIsRefused)
{
  // The smallest grain is 0.96 d_S = 0.48 d_L: gaps of 0.43 d_L retain it, gaps of 0.44 d_L do not.
  EXPECT_EQ(complaint_about({"--length", "28.6dL", "--base-spacing", "1.43dL"}), "");
  EXPECT_EQ(complaint_about({"--length", "28.8dL", "--base-spacing", "1.44dL"}), "base-spacing");
  EXPECT_EQ(complaint_about({"--length", "28.8dL", "--base-spacing", "1.44dL", "--spread", "0"}),
            "");
  EXPECT_EQ(complaint_about({"--base-spacing-spread", "0.86"}), "");
  EXPECT_EQ(complaint_about({"--base-spacing-spread", "0.88"}), "base-spacing-spread");
  EXPECT_EQ(complaint_about({"--base-diameter-spread", "0.86"}), "");
  EXPECT_EQ(complaint_about({"--base-diameter-spread", "0.88"}), "base-diameter-spread");
  // Pythagoras: two beads that touched have a gap of sqrt(1 + h^2) - 1 d_L if one is lowered by h d_L.
  EXPECT_EQ(complaint_about({"--base-height-spread", "1.02dL"}), "");
  EXPECT_EQ(complaint_about({"--base-height-spread", "1.04dL"}), "base-height-spread");
  // A bed of large grains only may have larger gaps.
  EXPECT_EQ(complaint_about({"--base-spacing", "1.44dL", "--phi-large", "1"}), "");
  EXPECT_EQ(complaint_about({"--base-spacing", "9dL"}), "base-spacing");
  EXPECT_EQ(complaint_about({"--base-diameter", "9dL"}), "base-diameter");
}

TEST(BaseRow, MayHaveGrainsThatOverlap)
{
  const auto base = base_of({"--length", "20dL", "--base-spacing", "0.5dL"});
  EXPECT_EQ(base.position.size(), 40U);
}

TEST(BaseRow, OfADrumIsARingOfGrains)
{
  EXPECT_EQ(complaint_about({"--geometry", "drum", "--lateral", "walls", "--base", "wall"}),
            "base");
}

TEST(BaseRow, IsThatOfABedOfGrains)
{
  for (const auto& where : {Words{"--base", "wall"}, Words{"--geometry", "shear"},
                            Words{"--geometry", "column", "--lateral", "walls"},
                            Words{"--geometry", "drum", "--lateral", "walls"},
                            Words{"--geometry", "hopper", "--lateral", "walls"}}) {
    EXPECT_EQ(complaint_about(where), "");
    for (const auto& [key, value] : {std::pair{"base-diameter", "0.9dL"},
                                     {"base-diameter-spread", "0.1"},
                                     {"base-height-spread", "0.1dS"},
                                     {"base-spacing", "1.1dL"},
                                     {"base-spacing-spread", "0.1"}}) {
      auto words = where;
      words.insert(words.end(), {std::string("--") + key, value});
      EXPECT_EQ(complaint_about(words), key) << where.back();
    }
  }
}

}  // namespace
}  // namespace grseg
