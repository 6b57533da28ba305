// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/shown_run.hpp"

#include "formats/core/errors.hpp"
#include "tests/folder.hpp"
#include "tests/spheres.hpp"
#include "tests/three_grains.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace grseg {
namespace {

using Numbers = std::vector<std::size_t>;

class ShownRunTest : public TestInFolder {
 protected:
  template <int D>
  ShownRun shown(const RunDescription& run, const std::vector<Frame<D>>& frames)
  {
    TrajectoryWriter writer(path("run.h5"), run);
    for (const auto& frame : frames)
      writer.append(frame, std::vector<double>(run.observables.size(), 0.0));
    writer.close();
    const TrajectoryReader reader(path("run.h5"));
    Numbers all;
    for (std::size_t k = 0; k < frames.size(); ++k) all.push_back(k);
    return show_run<D>(reader, reader.grains(), all);
  }
};

TEST(EvenlySpaced, FramesLieAsFarApartAsTheirNumberAsks)
{
  Numbers frames;
  for (std::size_t k = 0; k < 10; ++k) frames.push_back(100 + k);
  EXPECT_EQ(evenly_spaced(frames, 20), frames);
  EXPECT_EQ(evenly_spaced(frames, 10), frames);
  EXPECT_EQ(evenly_spaced(frames, 5), (Numbers{100, 102, 104, 106, 108}));
  EXPECT_EQ(evenly_spaced(frames, 3), (Numbers{100, 103, 106, 109}));
  EXPECT_EQ(evenly_spaced(frames, 1), (Numbers{100}));
}

TEST(EvenlySpaced, ThereAreTwoThirdsToOneAndAHalfTimesAsManyAsAskedFor)
{
  for (std::size_t n = 1; n < 2000; n += 7) {
    const auto count = evenly_spaced(Numbers(n, 0), 100).size();
    EXPECT_LE(count, std::min<std::size_t>(n, 150)) << n;
    EXPECT_GE(count, std::min<std::size_t>(n, 66)) << n;
  }
}

TEST_F(ShownRunTest, AForceIsThatAlongTheBranchAndThatToItsLeft)
{
  const auto run = shown<2>(three_grains::description(), {three_grains::frame(3)});
  ASSERT_EQ(run.frames.size(), 1u);
  const auto& frame = run.frames[0];
  EXPECT_EQ(frame.step, 1500);
  EXPECT_EQ(frame.i, (std::vector<std::int32_t>{0, 0}));
  EXPECT_EQ(frame.j, (std::vector<std::int32_t>{1, 2}));
  // Force (1e-4, -2e-4) on the large grain from the small one above; the branch points down.
  EXPECT_FLOAT_EQ(frame.along[0], 2e-4f);
  EXPECT_FLOAT_EQ(frame.across[0], 1e-4f);
  // Force (-3e-4, 1e-3) on the large grain from the base below; the branch points up.
  EXPECT_FLOAT_EQ(frame.along[1], 1e-3f);
  EXPECT_FLOAT_EQ(frame.across[1], 3e-4f);
  EXPECT_FLOAT_EQ(frame.x[1], 0.053f);
  EXPECT_FLOAT_EQ(frame.y[1], 0.0125f);
  EXPECT_EQ(run.species, (std::vector<Species>{Species::large, Species::small, Species::boundary}));
}

TEST_F(ShownRunTest, ContactsWithoutForceAreNotShownAndOthersAreInOrder)
{
  auto frame = three_grains::frame(0);
  auto& contacts = frame.contacts;
  std::swap(contacts.j[0], contacts.j[1]);
  std::swap(contacts.force[0], contacts.force[1]);
  std::swap(contacts.branch[0], contacts.branch[1]);
  auto without = frame;
  without.step += 500;
  without.time += 0.05;
  without.contacts.force[0].setZero();
  const auto run = shown<2>(three_grains::description(), {frame, without});
  EXPECT_EQ(run.frames[0].j, (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(run.frames[1].j, (std::vector<std::int32_t>{1}));
}

/// Adds a contact of grain 1 with a wall on its right.
void touch_wall(Frame<2>& frame, std::int32_t j)
{
  auto& contacts = frame.contacts;
  contacts.i.push_back(1);
  contacts.j.push_back(j);
  contacts.force.emplace_back(-1e-4, 0);
  contacts.branch.emplace_back(-0.0025, 0);
  contacts.gap.push_back(0);
}

TEST_F(ShownRunTest, AWallIsKnownFromItsFirstContactOn)
{
  const auto alone = three_grains::frame(0);
  auto at_wall = three_grains::frame(1);
  touch_wall(at_wall, -3);
  const auto run = shown<2>(three_grains::description(), {alone, at_wall, three_grains::frame(2)});
  EXPECT_TRUE(run.frames[0].walls.empty());
  for (const std::size_t k : {1u, 2u}) {
    ASSERT_EQ(run.frames[k].walls.size(), 1u) << "of walls that nothing touches nothing is known";
    const auto& wall = run.frames[k].walls[0];
    EXPECT_FLOAT_EQ(wall.normal_x, -1);
    EXPECT_FLOAT_EQ(wall.normal_y, 0);
    EXPECT_FLOAT_EQ(wall.offset, -(0.051f + 0.0025f));
  }
}

TEST_F(ShownRunTest, AWallOfAnyNumberIsOneWall)
{
  auto frame = three_grains::frame(0);
  touch_wall(frame, std::numeric_limits<std::int32_t>::min());
  touch_wall(frame, -1);
  const auto run = shown<2>(three_grains::description(), {frame});
  EXPECT_EQ(run.frames[0].walls.size(), 2u);
  const auto& j = run.frames[0].j;
  ASSERT_EQ(std::count_if(j.begin(), j.end(), [](std::int32_t one) { return one < 0; }), 2);
  for (const auto one : j) EXPECT_GE(one, -2);
}

TEST_F(ShownRunTest, MoreWallsThanAnySceneHasAreRefused)
{
  auto frame = three_grains::frame(0);
  for (std::int32_t wall = 0; wall <= static_cast<std::int32_t>(most_walls); ++wall)
    touch_wall(frame, -1 - wall);
  const auto said =
      complaint_of<FormatError>([&] { shown<2>(three_grains::description(), {frame}); });
  EXPECT_NE(said.find("more than 1000 walls"), std::string::npos) << said;
}

TEST_F(ShownRunTest, GravityIsThatOfTheTimeWhereTheSlopeTurns)
{
  auto description = three_grains::description();
  description.parameters.numbers["slope_rate"] = {10};  // degrees per second
  const auto run = shown<2>(description, {three_grains::frame(0), three_grains::frame(3)});
  EXPECT_GT((run.frames[1].gravity - run.frames[0].gravity).norm(), 1e-3);
  const double turned =
      std::acos(run.frames[0].gravity.normalized().dot(run.frames[1].gravity.normalized()));
  EXPECT_NEAR(turned, std::numbers::pi / 18 * (run.frames[1].time - run.frames[0].time), 1e-6);
}

TEST_F(ShownRunTest, OfSpheresThereIsTheSliceHalfWayAcrossThatIsAsThickAsTheLargest)
{
  const auto description = spheres::description();
  const double middle = description.box.length_z / 2;
  auto frame = spheres::frame(0);
  const double z[] = {-0.0059, 0.003, 0.0059, 0.0061};  // the largest diameter is 0.012
  for (std::size_t g = 0; g < 4; ++g) frame.position[g].z() = middle + z[g];
  const auto run = shown<3>(description, {frame});
  ASSERT_EQ(run.row, (std::vector<std::uint32_t>{0, 1, 2})) << "the base lies behind the slice";
  for (std::size_t g = 0; g < 3; ++g) EXPECT_NEAR(run.frames[0].z[g], z[g], 1e-9);
  EXPECT_NEAR(run.radius[1], 0.004, 1e-9) << "spheres are whole";
  // Only contacts of which both grains are shown; forces are components in the plane.
  for (std::size_t k = 0; k < run.frames[0].i.size(); ++k) EXPECT_NE(run.frames[0].j[k], 3);
  const Vec2 force(-0.017, 0.013), branch(-0.007, 0.006);
  ASSERT_EQ(run.frames[0].i[1], 1);
  EXPECT_NEAR(run.frames[0].along[1], force.dot(branch) / branch.norm(), 1e-8);
}

TEST_F(ShownRunTest, GrainsThatAreNeverShownLeaveNoGapInTheNumbersOfOthers)
{
  const auto description = spheres::description();
  auto frame = spheres::frame(0);
  const double plane = description.box.length_z / 2;
  for (auto& position : frame.position) position.z() = plane;
  frame.position[0].z() = plane + 0.0065;
  const auto run = shown<3>(description, {frame});
  EXPECT_EQ(run.row, (std::vector<std::uint32_t>{1, 2, 3}));
  // The remaining contacts of the fine grain (now 1): with the middle grain (now 0) and with wall 1.
  EXPECT_EQ(run.frames[0].i, (std::vector<std::int32_t>{1, 1}));
  EXPECT_EQ(run.frames[0].j, (std::vector<std::int32_t>{-2, 0}));
}

}  // namespace
}  // namespace grseg
