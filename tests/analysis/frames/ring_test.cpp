// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/ring.hpp"

#include "formats/trajectory/writer.hpp"
#include "tests/analysis/grain_builder.hpp"
#include "tests/three_grains.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

namespace grseg {
namespace {

namespace fs = std::filesystem;

const Vec2 centre(0.3, -0.1);

class RingOfARun : public testing::Test {
 protected:
  fs::path path = fs::temp_directory_path() / fmt::format("grseg_ring_{}.h5", getpid());
  void TearDown() override { fs::remove(path); }

  /// The ring of a run with one frame of these grains.
  std::optional<Ring> ring_of(PackingOf<2>& packing)
  {
    auto description = three_grains::description();
    description.box.periodic_x = false;
    description.grains = packing.grains;
    auto& frame = packing.frame;
    frame.force.assign(packing.grains.size(), Vec2::Zero());
    frame.image.assign(packing.grains.size(), {0, 0});
    {
      TrajectoryWriter writer(path, description, {});
      writer.append(frame, std::vector<double>{0});
      writer.close();
    }
    return find_ring(TrajectoryReader(path));
  }

  /// A small grain that touches a wall at `point`; `inward` points from there to its centre.
  static void touch(PackingOf<2>& packing, const Vec2& point, const Vec2& inward)
  {
    constexpr double radius = 0.002;
    const auto g = packing.grain(Species::small, radius, point + radius * inward);
    packing.wall_contact(g, 0, inward, radius * inward);
  }
};

TEST_F(RingOfARun, IsFoundFromAQuarterOfItsCircle)
{
  PackingOf<2> packing;
  for (int k = 0; k < 12; ++k) {
    const double angle = -2.5 + 0.13 * k;
    const Vec2 out(std::cos(angle), std::sin(angle));
    touch(packing, centre + 0.05 * out, -out);
  }
  const auto ring = ring_of(packing);
  ASSERT_TRUE(ring);
  EXPECT_NEAR((ring->centre - centre).norm(), 0, 1e-12);
  EXPECT_NEAR(ring->radius, 0.05, 1e-12);
}

TEST_F(RingOfARun, IsFoundFromBoundaryGrains)
{
  PackingOf<2> packing;
  packing.grain(Species::small, 0.002, centre);
  for (int k = 0; k < 30; ++k)
    packing.grain(Species::boundary, 0.002,
                  centre + 0.05 * Vec2(std::cos(0.2 * k), std::sin(0.2 * k)));
  const auto ring = ring_of(packing);
  ASSERT_TRUE(ring);
  EXPECT_NEAR((ring->centre - centre).norm(), 0, 1e-12);
}

TEST_F(RingOfARun, IsNotFoundOnAFloorInACornerOrOnTwoRings)
{
  PackingOf<2> floor, corner, rings;
  for (int k = 0; k < 12; ++k) {
    touch(floor, {0.01 * k, 0}, {0, 1});
    touch(corner, k < 6 ? Vec2(0.01 * (k + 1), 0) : Vec2(0, 0.01 * (k - 5)), {1, 0});
    const Vec2 out(std::cos(0.5 * k), std::sin(0.5 * k));
    touch(rings, centre + (k % 2 == 0 ? 0.05 : 0.03) * out, -out);
  }
  EXPECT_FALSE(ring_of(floor));
  EXPECT_FALSE(ring_of(corner));
  EXPECT_FALSE(ring_of(rings));
}

}  // namespace
}  // namespace grseg
