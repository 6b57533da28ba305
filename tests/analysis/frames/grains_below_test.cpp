// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/grains_below.hpp"

#include "formats/core/species.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace grseg {
namespace {

/// Rows of the mobile grains that remain.
template <int D>
std::vector<std::size_t> remaining(PackingOf<D>& packing,
                                   ContactsAcross across = ContactsAcross::removed)
{
  const auto before = number_present(packing.frame);
  const auto removed = remove_grains_below(packing.grains, packing.frame, across);
  EXPECT_EQ(removed, before - number_present(packing.frame));
  std::vector<std::size_t> rows;
  for (std::size_t g = 0; g < packing.grains.size(); ++g)
    if (is_mobile(packing.grains, packing.frame, g)) rows.push_back(g);
  return rows;
}

using Rows = std::vector<std::size_t>;

/// A bead of the base, and a large grain of diameter 2 above it.
template <int D>
PackingOf<D> base_and_large()
{
  PackingOf<D> packing;
  packing.grain(Species::boundary, 1, -Vector<D>::Unit(1));
  packing.grain(Species::large, 1, Vector<D>::Unit(1));
  return packing;
}

template <int D>
void expect_that_grains_leave()
{
  auto packing = base_and_large<D>();
  packing.grain(Species::small, 0.5, -1.99 * Vector<D>::Unit(1));
  packing.grain(Species::small, 0.5, -2.01 * Vector<D>::Unit(1));
  packing.grain(Species::large, 1, -500 * Vector<D>::Unit(1));
  EXPECT_EQ(remaining(packing), (Rows{1, 2}));
}

// The largest diameter is 2: within it grains of any size still count.
TEST(GrainsBelow, HaveLeftTheBedBeyondALargestDiameter)
{
  expect_that_grains_leave<2>();
  expect_that_grains_leave<3>();
}

TEST(GrainsBelow, TakeTheirContactsWithThem)
{
  auto packing = base_and_large<2>();
  const auto left = packing.grain(Species::small, 0.5, {0, -2.5});
  const auto floor = packing.grain(Species::small, 0.5, {0, -3.5});
  packing.contact(1, 0, {0, 3});
  packing.contact(1, left, {0, 4});
  packing.contact(left, floor, {0, 5});
  packing.wall_contact(floor, 0, {0, 6}, {0, 0.5});
  packing.wall_contact(1, 1, {7, 0}, {1, 0});
  EXPECT_EQ(remaining(packing), Rows{1});
  const auto& contacts = packing.frame.contacts;
  EXPECT_EQ(contacts.i, (std::vector<std::int32_t>{1, 1}));
  EXPECT_EQ(contacts.j, (std::vector<std::int32_t>{0, -2}));
  EXPECT_EQ(contacts.force, (std::vector<Vec2>{{0, 3}, {7, 0}}));
  EXPECT_EQ(contacts.branch.size(), 2u);
  EXPECT_EQ(contacts.gap.size(), 2u);
}

// Grain 1 is of the bed. It is the first or the second of its contacts with a grain that has left.
TEST(GrainsBelow, PushTheBedFromOutsideAsTheBaseDoes)
{
  auto packing = base_and_large<2>();
  const auto left = packing.grain(Species::small, 0.5, {0, -2.5});
  const auto also = packing.grain(Species::small, 0.5, {1, -2.5});
  packing.contact(1, left, {0, 4});
  packing.contact(also, 1, {1, -5});
  packing.contact(left, also, {7, 0});
  packing.contact(also, 0, {0, -8});
  packing.wall_contact(left, 0, {0, 6}, {0, 0.5});
  const auto branch = packing.frame.contacts.branch;
  EXPECT_EQ(remaining(packing, ContactsAcross::kept), Rows{1});
  const auto& contacts = packing.frame.contacts;
  EXPECT_EQ(contacts.i, (std::vector<std::int32_t>{1, 1}));
  EXPECT_EQ(contacts.j, (std::vector<std::int32_t>{left, also}));
  EXPECT_EQ(contacts.force, (std::vector<Vec2>{{0, 4}, {-1, 5}}));
  EXPECT_EQ(contacts.branch, (std::vector<Vec2>{branch[0], -branch[1]}));
  for (std::size_t k = 0; k < contacts.size(); ++k)
    EXPECT_FALSE(partners(packing.grains, packing.frame, k).j);
}

TEST(GrainsBelow, DoNotLieBetweenTheBeadsOfADeepOrShakenBase)
{
  auto packing = base_and_large<2>();
  const auto bead = packing.grain(Species::boundary, 1, {3, -6});
  packing.grain(Species::small, 0.5, {4, -5.9});
  packing.grain(Species::small, 0.5, {4, -6.1});
  EXPECT_EQ(remaining(packing), (Rows{1, 3}));
  make_absent(packing.frame, static_cast<std::size_t>(bead));
  EXPECT_EQ(remaining(packing), Rows{1}) << "an absent bead holds nothing";
}

TEST(GrainsBelow, AreFoundWithoutVelocitiesAndForces)
{
  auto packing = base_and_large<3>();
  packing.grain(Species::small, 0.5, {0, -9, 0});
  packing.frame.velocity.clear();
  packing.frame.angular_velocity.clear();
  EXPECT_EQ(remaining(packing), Rows{1});
}

}  // namespace
}  // namespace grseg
