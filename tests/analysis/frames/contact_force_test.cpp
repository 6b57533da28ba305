// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/contacts.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

TEST(ContactForce, ItsPartsAreAlongTheBranchAndAcrossItCounterClockwise)
{
  const Vec2 n{0.6, 0.8}, t{-0.8, 0.6};
  ContactList<2> contacts;
  contacts.force = {3 * n + 2 * t};
  contacts.branch = {1.7 * n};
  const auto parts = force_parts(contacts, 0);
  EXPECT_NEAR(parts.f_n, 3, 1e-15);
  EXPECT_NEAR(parts.f_t, 2, 1e-15);
}

TEST(ContactForce, AContactBearsAForceIfAnyComponentIsNotZero)
{
  ContactList<2> contacts;
  contacts.force = {{0, 0}, {1e-300, 0}, {0, -1}};
  EXPECT_FALSE(bears_force(contacts, 0));
  EXPECT_TRUE(bears_force(contacts, 1));
  EXPECT_TRUE(bears_force(contacts, 2));
}

}  // namespace
}  // namespace grseg
