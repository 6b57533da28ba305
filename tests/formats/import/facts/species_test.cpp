// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/species.hpp"

#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using lammps_text::mentions;
constexpr auto small = Species::small, large = Species::large, boundary = Species::boundary;

ArchiveGrains grains_of_diameters(const std::vector<double>& diameters)
{
  ArchiveGrains grains;
  for (std::size_t g = 0; g < diameters.size(); ++g) {
    grains.id.push_back(static_cast<std::int64_t>(g) + 10);
    grains.radius.push_back(diameters[g] / 2);
  }
  return grains;
}

std::string complaint(const ArchiveGrains& grains, const SpeciesSettings& settings)
{
  try {
    assign_species(grains, settings);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(Species, TwoSizesFarApartAreSeparatedWhateverTheirSpread)
{
  SpeciesSettings settings;
  settings.boundary = "none";
  const auto found =
      assign_species(grains_of_diameters({0.0048, 0.0104, 0.0052, 0.0096}), settings);
  EXPECT_EQ(found.species, (std::vector{small, large, small, large}));
  EXPECT_TRUE(mentions(found.sizes, "below 0.0074, half-way"));
}

TEST(Species, OneSizeOrABroadMixtureIsRefusedWithItsHistogram)
{
  SpeciesSettings settings;
  settings.boundary = "none";
  EXPECT_TRUE(mentions(complaint(grains_of_diameters({0.01, 0.01}), settings), "0.01: 2"));
  const auto broad = complaint(grains_of_diameters({1, 1.3, 1.6, 2, 2.4, 3, 11}), settings);
  EXPECT_TRUE(mentions(broad, "diameters are 1 to 2: 3, 2 to 3: 2, 3 to 4: 1, 10 to 11: 1;"))
      << broad;
  settings.split_diameter = 2;
  EXPECT_EQ(assign_species(grains_of_diameters({1, 2, 3}), settings).species,
            (std::vector{small, large, large}));
}

TEST(Species, BaseGrainsDoNotCountAsASize)
{
  SpeciesSettings settings;
  settings.boundary_ids = "11,13-14";
  const auto found = assign_species(grains_of_diameters({1, 9, 2, 8, 7}), settings);
  EXPECT_EQ(found.species, (std::vector{small, boundary, large, boundary, boundary}));
}

SpeciesSettings by_type(const std::optional<std::string>& small_types,
                        const std::optional<std::string>& large_types,
                        const std::string& boundary_types)
{
  SpeciesSettings settings;
  settings.small = small_types;
  settings.large = large_types;
  settings.boundary = boundary_types;
  return settings;
}

TEST(Species, TheArchivesOwnMarksAreTakenUnlessTypesAreNamed)
{
  auto grains = grains_of_diameters({1, 2, 2});
  grains.fixed = {0, 0, 1};
  grains.type = {4, 5, 6};
  EXPECT_EQ(assign_species(grains, {}).species, (std::vector{small, large, boundary}));
  EXPECT_EQ(assign_species(grains, by_type("5", "6", "4")).species,
            (std::vector{boundary, small, large}));
}

TEST(Species, ATypeMayBeCalledAll)
{
  auto grains = grains_of_diameters({1, 2});
  grains.type_names = {"all", "others"};
  grains.type = {0, 1};
  EXPECT_EQ(assign_species(grains, by_type("all", "others", "none")).species,
            (std::vector{small, large}));
  EXPECT_EQ(assign_species(grains, by_type("others", "all", "none")).species,
            (std::vector{large, small}));
  EXPECT_TRUE(mentions(complaint(grains, by_type("all", {}, "none")),
                       "type others of grain 11 is neither"));
}

TEST(Species, EveryTypeMustBelongSomewhereAndOnlyOnce)
{
  auto grains = grains_of_diameters({1, 2});
  grains.type = {1, 2};
  EXPECT_TRUE(
      mentions(complaint(grains, by_type("1", {}, "none")), "type 2 of grain 11 is neither"));
  EXPECT_TRUE(mentions(complaint(grains, by_type("1", "1-2", "none")),
                       "grain 10 is in --small and in --large"));
  EXPECT_TRUE(mentions(complaint(grains, by_type("1", "2", "7")),
                       "no grain belongs to the base (types 7)"));
  grains.type.clear();
  EXPECT_TRUE(mentions(complaint(grains, by_type("1", "2", "7")), "--boundary names types, but"));
}

TEST(Species, ListsAreNumbersAndRanges)
{
  const NumberList list("1,4-6", "--small");
  for (const int number : {1, 4, 5, 6}) EXPECT_TRUE(list.contains(number));
  for (const int number : {0, 2, 3, 7}) EXPECT_FALSE(list.contains(number));
  for (const char* text : {"", "1,", "a", "3-1", "1-", "-1"})
    EXPECT_THROW(NumberList(text, "--small"), UsageError) << text;
}

}  // namespace
}  // namespace grseg
