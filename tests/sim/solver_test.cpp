// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

TEST(Solver, AVelocityFarBelowTheFloorNeedsNoSecondSweep)
{
  std::vector<Motion> motion{{0, -1e-12, 0, 1}, {0, 0, 0, 0}};
  Contact c{};
  c.ny = c.kappa = c.mass_n = 1;
  c.mass_t = 1.0 / 3;
  c.j = 1;
  std::vector<Contact> contacts{c};
  EXPECT_EQ(solve_contacts(contacts, motion, 0.5, {}, {1e-2, 100}, 1e-6).sweeps, 1);
}

TEST(Solver, ANewcomerIsNotHiddenByThousandsOfSettledContacts)
{
  // 4000 discs that rest on a floor, their impulses known, beside a row of 10 touching discs of
  // which the first is hit: without restitution all ten end with a tenth of its speed.
  const int row = 10, settled = 4000;
  std::vector<Motion> motion;
  std::vector<Contact> contacts;
  const auto join = [&](int i, int j, double nx, double ny, double mass, double impulse) {
    Contact c{};
    c.nx = nx, c.ny = ny, c.kappa = 1;
    c.mass_n = mass, c.mass_t = mass / 3;
    c.impulse_n = impulse;
    c.i = i, c.j = j;
    contacts.push_back(c);
  };
  for (int k = 0; k < row; ++k) motion.push_back({k == 0 ? 1.0 : 0.0, 0, 0, 1});
  for (int k = 0; k < settled; ++k) motion.push_back({0, -1, 0, 1});
  motion.push_back({});
  for (int k = 0; k < settled; ++k) join(row + k, row + settled, 0, 1, 1, 1);
  for (int k = row - 2; k >= 0; --k) join(k + 1, k, 1, 0, 0.5, 0);
  const auto report = solve_contacts(contacts, motion, 0, {}, {1e-3, 100000}, 0);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.residual, 1e-3);
  EXPECT_LE(contact_residual(contacts, motion, 0, {}), 1e-3);
  for (int k = 0; k < row; ++k) EXPECT_NEAR(motion[static_cast<std::size_t>(k)].vx, 0.1, 0.05);
}

}  // namespace
}  // namespace grseg
