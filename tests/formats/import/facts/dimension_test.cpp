// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/axes.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using lammps_text::mentions;

ArchiveFrame frame_of(const std::vector<Vec3>& positions)
{
  ArchiveFrame frame;
  frame.place = "step 7";
  for (const auto& x : positions) {
    frame.grains.id.push_back(static_cast<std::int64_t>(frame.grains.id.size()));
    frame.grains.position.push_back(x);
    frame.grains.radius.push_back(0.5);
  }
  return frame;
}

const auto in_x_y = frame_of({{0, 0, 3}, {1, 0, 3.04}, {0, 1, 3}});
const auto in_x_z = frame_of({{0, 3, 0}, {1, 3, 0}, {0, 3, 1}});
const auto in_space = frame_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});

std::string complaint(const ArchiveFrame& frame, const std::string& axes, bool discs,
                      std::optional<int> asked = {})
{
  try {
    return fmt::format("dimension {}", dimension_of(frame, axes, discs, asked));
  } catch (const UsageError& error) {
    return error.what();
  }
}

TEST(Dimension, IsTwoWhereDiscsOrSpheresLieInThePlaneOfTheFlow)
{
  for (const bool discs : {true, false}) {
    EXPECT_EQ(dimension_of(in_x_y, "xy", discs, {}), 2);
    EXPECT_EQ(dimension_of(in_x_z, "xz", discs, {}), 2);
    EXPECT_EQ(dimension_of(in_x_z, "zx", discs, 2), 2);
  }
}

TEST(Dimension, IsThreeWhereSpheresDoNotOrOnRequest)
{
  for (const char* axes : {"xy", "xz", "zy"}) EXPECT_EQ(dimension_of(in_space, axes, false, {}), 3);
  EXPECT_EQ(dimension_of(in_space, "xy", false, 3), 3);
  EXPECT_EQ(dimension_of(in_x_y, "xy", false, 3), 3);
  EXPECT_EQ(dimension_of(in_x_y, "xz", false, 3), 3);
}

TEST(Dimension, AnotherPlaneThanThatOfTheAxesIsNamed)
{
  const auto said = complaint(in_x_z, "xy", false);
  EXPECT_TRUE(mentions(said, "step 7: grains are up to 1 apart across the plane of the flow"));
  EXPECT_TRUE(mentions(said, "pass --axes xz for a flow in it, or --dimension 3"));
  EXPECT_TRUE(mentions(complaint(in_x_y, "yz", true), "they lie in another plane: pass --axes xy"));
}

TEST(Dimension, DiscsInSpaceAndAPlaneThatIsNoneAreRefused)
{
  EXPECT_TRUE(mentions(complaint(in_space, "xy", true), "but discs move in a plane: name it with"));
  EXPECT_TRUE(
      mentions(complaint(in_x_y, "xy", true, 3), "--dimension 3, but the grains are discs"));
  EXPECT_TRUE(mentions(complaint(in_space, "xz", false, 2), "not a flow in two dimensions; leave"));
  EXPECT_TRUE(mentions(complaint(in_x_y, "xy", false, 1), "--dimension 1 is neither 2 nor 3"));
}

}  // namespace
}  // namespace grseg
