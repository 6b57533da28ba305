// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/species.hpp"
#include "formats/trajectory/reader.hpp"
#include "tests/formats/import/flow_in_space.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using lammps_text::mentions;
constexpr auto boundary = Species::boundary;

Species number(int k)
{
  return static_cast<Species>(k);
}

/// Grains of types 1 to 6; type 6 is the base.
ArchiveGrains grains_of_six_types()
{
  ArchiveGrains grains;
  const std::pair<int, double> all[] = {{5, 9}, {1, 4}, {2, 1}, {6, 7}, {3, 2}, {4, 3}, {2, 2}};
  for (const auto& [type, diameter] : all) {
    grains.id.push_back(static_cast<std::int64_t>(grains.id.size()) + 10);
    grains.type.push_back(type);
    grains.radius.push_back(diameter / 2);
  }
  return grains;
}

SpeciesSettings named(const std::vector<std::string>& texts)
{
  SpeciesSettings settings;
  settings.named = texts;
  settings.boundary = "6";
  return settings;
}

std::string complaint(const SpeciesSettings& settings, ArchiveGrains grains = grains_of_six_types())
{
  try {
    assign_species(grains, settings);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no complaint";
}

std::vector<std::string> names_in(const SpeciesFound& found)
{
  std::vector<std::string> names;
  for (const auto& [name, diameter] : found.list) names.push_back(name);
  return names;
}

TEST(NamedSpecies, AreNumberedInOrderOfTheMeanOfTheirSmallestAndLargestDiameter)
{
  // Diameters 1 to 4, 2, 3 and 9.
  const auto found =
      assign_species(grains_of_six_types(), named({"huge=5", "wide=1,2", "SE=4", "AM=3"}));
  EXPECT_EQ(names_in(found), (std::vector<std::string>{"AM", "wide", "SE", "huge"}));
  EXPECT_EQ(found.species, (std::vector{number(3), number(1), number(1), boundary, number(0),
                                        number(2), number(1)}));
  EXPECT_EQ(found.sizes, "in order of size: AM types 3, wide types 1,2, SE types 4, huge types 5");
}

TEST(NamedSpecies, AGivenDiameterCountsInsteadOfThatOfTheGrains)
{
  const auto found =
      assign_species(grains_of_six_types(), named({"A=1,2:0.5", "B=3,4:0.25", "C=5", "D=7:12"}));
  EXPECT_EQ(names_in(found), (std::vector<std::string>{"B", "A", "C", "D"})) << "D has no grains";
  EXPECT_EQ(found.list[0].diameter, 0.25);
  EXPECT_EQ(found.list[2].diameter, 0) << "not given";
}

TEST(NamedSpecies, FiveOfThemAndOneAloneAreNumberedToo)
{
  const auto five =
      assign_species(grains_of_six_types(), named({"a=1", "z=2", "c=3", "d=4", "e=5"}));
  EXPECT_EQ(names_in(five), (std::vector<std::string>{"z", "c", "d", "a", "e"}));
  EXPECT_EQ(five.species, (std::vector{number(4), number(3), number(0), boundary, number(1),
                                       number(2), number(0)}));
  auto grains = grains_of_six_types();
  grains.fixed = {0, 1, 0, 0, 0, 0, 0};
  grains.type.clear();
  SpeciesSettings settings;
  settings.named = {"grains=all"};
  const auto one = assign_species(grains, settings);
  EXPECT_EQ(one.species, (std::vector{number(0), boundary, number(0), number(0), number(0),
                                      number(0), number(0)}));
  EXPECT_EQ(one.sizes, "in order of size: grains all grains");
}

TEST(NamedSpecies, EveryTypeBelongsToOneSpeciesAlone)
{
  EXPECT_TRUE(mentions(complaint(named({"A=1-3", "B=5"})),
                       "type 4 of grain 15 is in no --species; every type of a mobile grain"));
  EXPECT_TRUE(mentions(complaint(named({"A=1-4", "B=4-5"})),
                       "grain 15 is in --species A and in --species B"));
  EXPECT_TRUE(mentions(complaint(named({"A=all", "B=5"})),
                       "grain 10 is in --species A and in --species B"));
  EXPECT_TRUE(
      mentions(complaint(named({"A=1-5", "B=7"})),
               "--species B=7: no mobile grain has these types; leave the option out, or add the "
               "diameter, B=7:DIAMETER"));
  auto grains = grains_of_six_types();
  grains.type.clear();
  auto settings = named({"A=1-5"});
  settings.boundary = "none";
  EXPECT_TRUE(mentions(complaint(settings, grains), "have no types; --species NAME=all makes"));
}

TEST(NamedSpecies, NamesFitFilesAndTables)
{
  for (const char* name :
       {"", "a b", "a+b", "a,b", "a\tb", "sixteen.letters.", "\xc3\xa4", "boundary", "b"})
    EXPECT_TRUE(mentions(complaint(named({fmt::format("{}=1-5", name)})),
                         "names have 1 to 15 of the characters A-Z a-z 0-9 _ - ."))
        << name;
  EXPECT_EQ(complaint(named({"fifteen.letters=1-5"})), "no complaint");
  EXPECT_TRUE(mentions(complaint(named({"A=1-3", "A=4,5"})), "--species names A twice"));
}

TEST(NamedSpecies, WhatIsNotOfTheFormIsRefused)
{
  EXPECT_TRUE(mentions(complaint(named({"1-5"})), "'1-5' is not of the form NAME=TYPES"));
  EXPECT_TRUE(mentions(complaint(named({"A=x"})), "--species 'x' is not a list of numbers"));
  for (const char* diameter : {"", "0", "-1", "nan", "1m"})
    EXPECT_TRUE(mentions(complaint(named({fmt::format("A=1-5:{}", diameter)})), "not a diameter"));
  auto settings = named({"A=1-5"});
  settings.large_diameter = 2;
  EXPECT_TRUE(mentions(complaint(settings), "--large-diameter cannot be combined with --species"));
}

TEST(NamedSpecies, AreNamedWhereSizesAreNotTwo)
{
  SpeciesSettings settings;
  settings.boundary = "6";
  const auto said = complaint(settings);
  EXPECT_TRUE(mentions(said, "--species type1=1 --species type2=2"));
  EXPECT_TRUE(mentions(said, "or --species grains=all"));
}

TEST(NamedSpecies, AreInTheFileInOrderWithTheirNominalDiametersInMetres)
{
  const lammps_text::Folder folder;
  auto settings = flow_in_space::lammps(folder, flow_in_space::views()[1]);
  settings.species.named = {"SE=3:2.5", "AM=2", "none=7:0.125"};
  settings.units = "0.5:1:1";
  import_archive(settings, "");
  const TrajectoryReader run(settings.output);
  const auto& list = run.species();
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0].name + list[1].name + list[2].name, "noneAMSE");
  EXPECT_EQ(list[0].diameter, 0.0625);
  EXPECT_EQ(list[1].diameter, 0.5);
  EXPECT_EQ(list[2].diameter, 1.25);
  EXPECT_EQ(run.grains().species, (std::vector{boundary, number(2), number(1), number(1)}));
  EXPECT_EQ(run.small_diameter(), 0.0625);
  EXPECT_EQ(run.large_diameter(), 1.25);
}

}  // namespace
}  // namespace grseg
