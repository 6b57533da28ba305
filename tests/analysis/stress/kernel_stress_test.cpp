// SPDX-License-Identifier: GPL-3.0-or-later
// Contact stress spread along the branch by a kernel.
#include "tests/analysis/contact_packings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// Part below height y of a line from `from` to `to` that a Gaussian of width w spreads:
/// w (P((y - from)/w) - P((y - to)/w))/(to - from), P(u) = u Phi(u) + phi(u) being the primitive of
/// the normal distribution.
double part_below(double y, double from, double to, double w)
{
  const auto primitive = [](double u) {
    return u * std::erfc(-u / std::numbers::sqrt2) / 2 +
           std::exp(-u * u / 2) / std::sqrt(2 * std::numbers::pi);
  };
  return w * (primitive((y - from) / w) - primitive((y - to) / w)) / (to - from);
}

// The branch reaches from 1.25 to 2.75, the large grain's part of it from 1.75.
TEST(KernelStress, AKernelSpreadsTheBranchAndEachGrainsPartOfIt)
{
  const double w = 0.5;
  const auto stress = stress_of(large_on_small(), Assignment::kernel, 0, Kernel(w));
  const auto part_in = [w](std::size_t n, double from) {
    const auto y = static_cast<double>(n);
    return (n == 3 ? 1 : part_below(y + 1, from, 2.75, w)) -
           (n == 0 ? 0 : part_below(y, from, 2.75, w));
  };
  ASSERT_EQ(stress.layers(), 4U);
  for (std::size_t n = 0; n < 4; ++n) {
    const auto sums = stress.mean(n).sums;
    EXPECT_TRUE(same(sums.of(PairSum::whole, 0), mixed * part_in(n, 1.25))) << n;
    EXPECT_TRUE(same(sums.of(PairSum::by_power, 0), mixed * part_in(n, 1.25) / 2)) << n;
    for (const auto part : {PairSum::by_size, PairSum::up_to_contact})
      EXPECT_TRUE(same(sums.of(part, 0), mixed * 2 / 3 * part_in(n, 1.75))) << n;
  }
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
  for (const double width : {1e-3, 0.3, 2.0, 40.0}) {
    const auto spread = total(stress_of(packing, Assignment::kernel, {}, Kernel(width)));
    for (std::size_t c = 0; c < at_points.size(); ++c) EXPECT_NEAR(spread[c], at_points[c], 1e-12);
  }
}

TEST(KernelStress, ANarrowGaussianIsTheBranchAssignment)
{
  const Packing packing = heap();
  const auto along = stress_of(packing, Assignment::branch);
  const auto narrow = stress_of(packing, Assignment::kernel, {}, Kernel(1e-14));
  const auto wide = stress_of(packing, Assignment::kernel, {}, Kernel(0.1));
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
