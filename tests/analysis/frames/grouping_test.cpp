// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/grouping.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/writer.hpp"
#include "tests/folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace grseg {
namespace {

/// Run of spheres with these radii and species, and one boundary grain.
TrajectoryReader run_of(const std::string& path, const SpeciesList& species,
                        const std::vector<int>& numbers, const std::vector<double>& radii)
{
  RunDescription run;
  for (std::size_t g = 0; g <= radii.size(); ++g) {
    const bool base = g == radii.size();
    run.grains.id.push_back(static_cast<std::int32_t>(g));
    run.grains.species.push_back(base ? Species::boundary : static_cast<Species>(numbers[g]));
    run.grains.radius.push_back(base ? 9 : radii[g]);
    run.grains.mass.push_back(1);
    run.grains.fixed.push_back(base);
  }
  run.species = species;
  run.has_force = false;
  run.box = {10, 10, true, 3, 7, true};
  run.parameters.numbers = {{"gravity", {0, -9.81, 0}},
                            {"step", {1e-3}},
                            {"small_diameter", {species.front().diameter}},
                            {"large_diameter", {species.back().diameter}}};
  TrajectoryWriter(path, run).close();
  return TrajectoryReader(path);
}

std::vector<int> numbers(const GroupedGrains& result)
{
  std::vector<int> all;
  for (const auto species : result.grains.species) all.push_back(static_cast<int>(species));
  return all;
}

const SpeciesList three{{"fine", 2}, {"AM", 4}, {"SE", 6}};

struct Grouping : TestInFolder {
  /// Groups spheres of diameters 2, 4, 4.4, 6 and 2.2.
  GroupedGrains grouped(const GroupingOptions& options) const
  {
    return group_grains(run_of(path("run.h5"), three, {0, 1, 1, 2, 0}, {1, 2, 2.2, 3, 1.1}),
                        options);
  }
  std::string sentence_of(const GroupingOptions& options) const
  {
    try {
      grouped(options);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(Grouping, ByDefaultIsThatOfTheFile)
{
  const auto result = grouped({});
  EXPECT_EQ(numbers(result), (std::vector{0, 1, 1, 2, 0, -1}));
  EXPECT_EQ(result.species[1].name, "AM");
}

TEST_F(Grouping, MergesSpeciesByNumberOrNameInOrderOfSize)
{
  const auto result = grouped({.groups = {"coarse=SE,2", "dust=1"}});
  EXPECT_EQ(numbers(result), (std::vector{0, 1, 1, 1, 0, -1}));
  ASSERT_EQ(result.species.size(), 2u);
  EXPECT_EQ(result.species[0].name, "dust");
  EXPECT_EQ(result.species[0].diameter, 2);  // nominal diameter of a single species
  const auto power = [](double exponent) {
    return std::pow(4, exponent) + std::pow(4.4, exponent) + std::pow(6, exponent);
  };
  EXPECT_NEAR(result.species[1].diameter, power(3) / power(2), 1e-14);
}

TEST_F(Grouping, OfClassesHaveEqualVolumes)
{
  // Diameters 2, 2.2, 4, 4.4, 6: volumes 8, 10.6, 64, 85.2, 216 of 383.8; half is 191.9.
  EXPECT_EQ(numbers(grouped({.classes = 2})), (std::vector{0, 0, 0, 1, 0, -1}));
  EXPECT_EQ(numbers(grouped({.classes = 1})), (std::vector{0, 0, 0, 0, 0, -1}));
}

/// Number of grains in each class of a run, from the smallest class.
std::vector<std::size_t> grains_of_classes(const std::string& path,
                                           const std::vector<double>& radii, int classes)
{
  const std::vector<int> one(radii.size(), 0);
  const auto result = group_grains(run_of(path, {{"all", 2}}, one, radii), {.classes = classes});
  std::vector<std::size_t> counts(static_cast<std::size_t>(classes));
  for (const int number : numbers(result))
    if (number >= 0) ++counts[static_cast<std::size_t>(number)];
  return counts;
}

// 28 % of the volume is in 28 small grains, 40 % in five, 32 % in one; equal diameters differ by round-off.
TEST_F(Grouping, OfAsManyClassesAsSizesHasOneSizeInEach)
{
  std::vector<double> radii(28, 0.5);
  radii[3] += 1e-16;
  radii.insert(radii.end(), 5, 1.0);
  radii.push_back(std::cbrt(32) / 2);
  EXPECT_EQ(grains_of_classes(path("sizes.h5"), radii, 3), (std::vector<std::size_t>{28, 5, 1}));
  EXPECT_EQ(grains_of_classes(path("sizes2.h5"), radii, 2), (std::vector<std::size_t>{33, 1}));
}

// The grains up to the second size have 48 % of the volume, up to the third 58 %.
TEST_F(Grouping, ByClassesDividesAtTheSizeNearestToItsShare)
{
  std::vector<double> radii(8, 0.5);                // volume 8 of 100
  radii.insert(radii.end(), 5, 1.0);                // volume 40
  radii.insert(radii.end(), 1, std::cbrt(10) / 2);  // volume 10, diameter 2.15
  radii.insert(radii.end(), 1, std::cbrt(42) / 2);  // volume 42
  EXPECT_EQ(grains_of_classes(path("nearest.h5"), radii, 2), (std::vector<std::size_t>{13, 2}));
}

TEST_F(Grouping, ByEdgesDividesAtDiameters)
{
  const auto result = grouped({.edges = "2.1m,4m,5m"});
  EXPECT_EQ(numbers(result), (std::vector{0, 2, 2, 3, 1, -1}));
  EXPECT_NEAR(result.species[1].diameter, 2.2, 1e-14);
  EXPECT_EQ(numbers(grouped({.edges = "1.05dS"})), (std::vector{0, 1, 1, 1, 1, -1}));
}

TEST_F(Grouping, ThatCannotBeIsRefusedInOneSentence)
{
  const auto says = [&](const GroupingOptions& options, const std::string& words) {
    const auto sentence = sentence_of(options);
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
  };
  says({.groups = {"A=1,2"}}, "species 3 (SE) is in no --group");
  says({.groups = {"A=1,2", "B=2,3"}}, "species 2 is in two groups");
  says({.groups = {"A=1,4"}}, "no species '4'; it has 1 fine, 2 AM, 3 SE");
  says({.groups = {"A+B=1,2,3"}}, "NAME=LIST");
  says({.groups = {"b=1,2,3"}}, "'b' denotes boundary grains");
  says({.groups = {"A=1", "A=2,3"}}, "given twice");
  says({.groups = {"A=1,2,3"}, .classes = 2}, "exclude each other");
  says({.classes = 9}, "have only 5 different diameters");
  says({.classes = -1}, "must be 1 to 100");
  says({.edges = "4m,2m"}, "increasing order");
  says({.edges = "1m,4m"}, "no mobile grain belongs to c1");
}

}  // namespace
}  // namespace grseg
