// SPDX-License-Identifier: GPL-3.0-or-later
// Contact stress spread along the branch by a kernel.
#include "tests/analysis/contact_packings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

// The branch from 1.25 to 2.75 is spread by half a unit up and down. A point at y <= 1.5 of it
// reaches below 1 by 1.5 - y: together a 48th of the whole. The large grain's part reaches below 2
// by 2.5 - y and above 3 by y - 2.5.
TEST(KernelStress, AKernelSpreadsTheBranchAndEachGrainsPartOfIt)
{
  const Kernel box(KernelShape::heaviside, 0.5);
  const auto stress = stress_of(large_on_small(), Assignment::kernel, 0, box);
  const auto at = [&](std::size_t n) { return stress.mean(n).sums; };
  EXPECT_TRUE(same(at(0).of(PairSum::whole, 0), mixed / 48));
  EXPECT_TRUE(same(at(1).of(PairSum::whole, 0), mixed * 23 / 48));
  EXPECT_TRUE(same(at(2).of(PairSum::whole, 0), mixed * 23 / 48));
  EXPECT_TRUE(same(at(3).of(PairSum::whole, 0), mixed / 48));
  for (const auto part : {PairSum::by_size, PairSum::up_to_contact}) {
    EXPECT_TRUE(same(at(0).of(part, 0), mixed * 0));
    EXPECT_TRUE(same(at(1).of(part, 0), mixed * 2 / 3 * 9 / 32));
    EXPECT_TRUE(same(at(2).of(part, 0), mixed * 2 / 3 * 22 / 32));
    EXPECT_TRUE(same(at(3).of(part, 0), mixed * 2 / 3 / 32));
  }
  EXPECT_TRUE(same(at(0).of(PairSum::by_power, 0), mixed / 96));
  EXPECT_EQ(stress.mean(1).contacts[1], 1);
}

// Weinhart et al. (2012): a contact with the base is stress of the flow from the grain's centre to
// the contact point, here 1.25 to 0.75; the rest of the branch does not belong to the flow.
TEST(KernelStress, UnderAKernelTheBaseBranchEndsAtTheContactPoint)
{
  const auto stress = stress_of(small_on_base(), Assignment::kernel);
  for (const std::size_t n : {0U, 1U}) {
    const double below = smooth.below_along(1, 0.75, 1.25),
                 whole = smooth.below_along(1, -0.25, 1.25);
    EXPECT_TRUE(
        same(stress.mean(n).sums.of(OwnSum::base, 0), mixed / 3 * (n == 0 ? below : 1 - below)));
    EXPECT_TRUE(
        same(stress.mean(n).sums.of(OwnSum::whole_base, 0), mixed * (n == 0 ? whole : 1 - whole)));
  }
}

TEST(KernelStress, NoWidthOfAKernelChangesTheTotal)
{
  const Packing packing = heap();
  const auto at_points = total(stress_of(packing, Assignment::contact_point));
  for (const auto shape : {KernelShape::gauss, KernelShape::lucy, KernelShape::heaviside})
    for (const double width : {1e-3, 0.3, 2.0, 40.0}) {
      const auto spread = total(stress_of(packing, Assignment::kernel, {}, {shape, width}));
      for (std::size_t c = 0; c < at_points.size(); ++c)
        EXPECT_NEAR(spread[c], at_points[c], 1e-12);
    }
}

TEST(KernelStress, ANarrowGaussianIsTheBranchAssignment)
{
  const Packing packing = heap();
  const auto along = stress_of(packing, Assignment::branch);
  const auto narrow = stress_of(packing, Assignment::kernel, {}, {KernelShape::gauss, 1e-14});
  const auto wide = stress_of(packing, Assignment::kernel, {}, {KernelShape::gauss, 0.1});
  double difference = 0;
  for (std::size_t n = 0; n < along.layers(); ++n)
    for (std::size_t c = 0; c < along.row(n).size(); ++c) {
      EXPECT_NEAR(narrow.row(n)[c], along.row(n)[c], 1e-12);
      difference = std::max(difference, std::abs(wide.row(n)[c] - along.row(n)[c]));
    }
  EXPECT_GT(difference, 1e-3);
}

// Momentum balance of the coarse-grained field: the net force on a grain is spread by the kernel.
TEST(KernelStress, UnderAKernelTheSumIsTheSpreadForceThroughTheLayer)
{
  const Packing packing = heap();
  const auto net = net_forces(packing);
  const auto stress = stress_of(packing, Assignment::kernel);
  for (std::size_t n = 1; n + 1 < stress.layers(); ++n) {
    Vec2 through = Vec2::Zero();
    for (std::size_t g = 0; g < net.size(); ++g) {
      const double y = packing.frame.position[g].y();
      through += net[g] * (1 - smooth.below_along(unit_layers.top(n), y, y + 1));
    }
    const auto s = stress.mean(n).sums;
    const Tensor2 sum = s.of(OwnSum::inside, 0) + s.of(OwnSum::inside, 1) +
                        s.of(PairSum::whole, 0) + s.of(OwnSum::whole_base, 0) +
                        s.of(OwnSum::whole_base, 1);
    EXPECT_NEAR(sum(0, 1), through.x(), 1e-12);
    EXPECT_NEAR(sum(1, 1), through.y(), 1e-12);
  }
}

}  // namespace
}  // namespace grseg
