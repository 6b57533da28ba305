// SPDX-License-Identifier: GPL-3.0-or-later
// Shares of a contact's stress for its two grains.
#include "analysis/stress/partition_rule.hpp"
#include "tests/analysis/contact_packings.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using Kind = PartitionRule::Kind;

TEST(ContactShares, AGrainHasItsShareWhicheverIsNamedFirst)
{
  Packing packing;
  const auto large = packing.grain(Species::large, 1, {0, 0});
  const auto small = packing.grain(Species::small, 0.5, {1.5, 0});
  packing.contact(large, small, {-1, 0});
  packing.contact(small, large, {1, 0});
  const PartitionRule rule{Kind::power, 2};  // 1/(1 + 1/4)
  const auto first = contact_shares(packing.grains, packing.frame, 0, rule);
  EXPECT_NEAR(first.i, 0.8, 1e-15);
  EXPECT_NEAR(first.j, 0.2, 1e-15);
  const auto second = contact_shares(packing.grains, packing.frame, 1, rule);
  EXPECT_NEAR(second.i, 0.2, 1e-15);
  EXPECT_NEAR(second.j, 0.8, 1e-15);
}

TEST(ContactShares, GrainsOfOneSpeciesAreCutWhereTheyTouchUnderAnyRule)
{
  Packing packing;
  const auto a = packing.grain(Species::small, 1, {0, 0});
  const auto b = packing.grain(Species::small, 0.5, {1.4, 0});  // they overlap by 0.1
  packing.contact(a, b, {-1, 0});
  for (const auto& rule : parse_rules({"stock", "uniform:0.9"})) {
    const auto shares = contact_shares(packing.grains, packing.frame, 0, rule);
    EXPECT_NEAR(shares.i, 0.95 / 1.4, 1e-15) << rule.name();
    EXPECT_NEAR(shares.j, 0.45 / 1.4, 1e-15) << rule.name();
  }
}

// The shares of grains, added up by species, equal the stresses from tables of sums under the same rule.
TEST(ContactShares, AddUpToTheStressOfTheSpecies)
{
  Packing packing;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0, 1);
  for (int g = 0; g < 20; ++g)
    packing.grain(g % 3 == 0 ? Species::large : Species::small, g % 3 == 0 ? 0.4 : 0.2,
                  {10 * number(random), number(random)});
  packing.grain(Species::boundary, 0.4, {5, 0});
  for (int g = 0; g + 1 < 21; ++g) packing.contact(g, g + 1, {number(random), number(random)});
  std::array<double, 2> trace{};
  for (std::size_t k = 0; k < packing.frame.contacts.size(); ++k) {
    const double whole = packing.frame.contacts.force[k].dot(packing.frame.contacts.branch[k]);
    const auto shares = contact_shares(packing.grains, packing.frame, k, {Kind::contact_point});
    const auto i = static_cast<std::size_t>(packing.frame.contacts.i[k]);
    const auto j = static_cast<std::size_t>(packing.frame.contacts.j[k]);
    trace[static_cast<std::size_t>(packing.grains.species[i])] += shares.i * whole;
    if (packing.grains.species[j] != Species::boundary)
      trace[static_cast<std::size_t>(packing.grains.species[j])] += shares.j * whole;
  }
  const auto sums = stress_of(packing, Assignment::contact_point);
  std::array<double, 2> expected{};
  for (std::size_t layer = 0; layer < sums.layers(); ++layer) {
    const auto mean = sums.mean(layer).sums;
    const double mixed = mean.of(PairSum::whole, 0).trace(),
                 large = mean.of(PairSum::up_to_contact, 0).trace();
    expected[0] +=
        mean.of(OwnSum::inside, 0).trace() + mean.of(OwnSum::base, 0).trace() + mixed - large;
    expected[1] += mean.of(OwnSum::inside, 1).trace() + mean.of(OwnSum::base, 1).trace() + large;
  }
  EXPECT_NEAR(trace[0], expected[0], 1e-12);
  EXPECT_NEAR(trace[1], expected[1], 1e-12);
}

TEST(ContactShares, AtAStraightWallAllIsTheGrains)
{
  Packing packing;
  const auto grain = packing.grain(Species::small, 0.5, {0, 0.5});
  packing.wall_contact(grain, 0, {0, 1}, {0, 0.5});
  const auto shares = contact_shares(packing.grains, packing.frame, 0, {});
  EXPECT_EQ(shares.i, 1);
  EXPECT_EQ(shares.j, 0);
}

}  // namespace
}  // namespace grseg
