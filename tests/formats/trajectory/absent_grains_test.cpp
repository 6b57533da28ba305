// SPDX-License-Identifier: GPL-3.0-or-later
// Grains that come and go: files that declare them have NaN for absent grains; mixed forms are refused.
#include "formats/trajectory/writer.hpp"
#include "tests/formats/trajectory/trajectory_fixture.hpp"

#include <cmath>
#include <limits>

namespace grseg {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Three frames of the three grains; the small grain, which lies on the large one, is absent in the
/// second frame.
class AbsentGrains : public Trajectory {
 protected:
  static Frame<2> frame_without_small(std::int64_t number)
  {
    auto frame = three_grains::frame(number);
    make_absent(frame, 1);
    auto& contacts = frame.contacts;
    contacts.i.erase(contacts.i.begin());
    contacts.j.erase(contacts.j.begin());
    contacts.force.erase(contacts.force.begin());
    contacts.branch.erase(contacts.branch.begin());
    contacts.gap.erase(contacts.gap.begin());
    return frame;
  }
  static RunDescription description()
  {
    auto run = three_grains::description();
    run.grains_come_and_go = true;
    return run;
  }
  void write(const Frame<2>& middle, const StorageSettings& storage = {}) const
  {
    TrajectoryWriter writer(path, description(), storage);
    writer.append(three_grains::frame(0), std::vector<double>{0});
    writer.append(middle, std::vector<double>{0});
    writer.append(three_grains::frame(2), std::vector<double>{0});
    writer.close();
  }
  void write() const { write(frame_without_small(1)); }
};

TEST_F(AbsentGrains, AreNaNInAllFieldsOfTheFrameAndPresentAgainAfterwards)
{
  for (const bool float32 : {false, true}) {
    write(frame_without_small(1), {.float32 = float32});
    EXPECT_EQ(complaint_of_all(), "no complaint");
    const TrajectoryReader run(path);
    EXPECT_TRUE(run.grains_come_and_go());
    Frame<2> frame;
    run.read(1, frame, {.velocity = true, .contacts = true, .force = true});
    EXPECT_TRUE(is_present(frame, 0));
    EXPECT_FALSE(is_present(frame, 1));
    EXPECT_TRUE(is_mobile(run.grains(), 1));
    EXPECT_FALSE(is_mobile(run.grains(), frame, 1));
    EXPECT_TRUE(frame.velocity[1].array().isNaN().all());
    EXPECT_TRUE(frame.force[1].array().isNaN().all());
    EXPECT_TRUE(std::isnan(frame.angular_velocity[1]));
    EXPECT_EQ(frame.image[1], (std::array{0, 0}));
    run.read(2, frame);
    EXPECT_TRUE(is_mobile(run.grains(), frame, 1));
    EXPECT_EQ(run.damage_outside_frames(), "");
    fs::remove(path);
  }
}

TEST_F(AbsentGrains, SurviveAChangeOfStorageWithTheirDigest)
{
  write();
  const std::string packed = path + ".packed";
  repack(path, packed, {.compression = 4});
  const TrajectoryReader before(path), after(packed);
  EXPECT_TRUE(after.grains_come_and_go());
  EXPECT_EQ(after.digest(), before.digest());
  fs::remove(packed);
}

TEST_F(AbsentGrains, AreRefusedInARunThatDoesNotSayThatGrainsComeAndGo)
{
  TrajectoryWriter writer(path, three_grains::description());
  writer.append(three_grains::frame(0), std::vector<double>{0});
  try {
    writer.append(frame_without_small(1), std::vector<double>{0});
    FAIL() << "was written";
  } catch (const RunError& error) {
    EXPECT_EQ(error.what(), path +
                                ": grain 8 has no position in frame 1, but this run allows no "
                                "absent grains");
  }
}

TEST_F(AbsentGrains, NaNInARunWhoseGrainsAreAlwaysThereIsDamage)
{
  three_grains::write(path, 2);
  tamper([](hid_t file) {
    for (const hsize_t axis : {0U, 1U})
      put(file, "/particles/grains/position/value", 6 + 2 + axis, nan);
  });
  EXPECT_EQ(complaint({}, Verify::no),
            path +
                ": /particles/grains/position/value is not a finite number in frame 1, entry 2; "
                "the frame is damaged");
}

TEST_F(AbsentGrains, AGrainThatIsThereByHalfIsNamed)
{
  const auto complaint_of = [&](const char* field, hsize_t entry, double value) {
    write();
    tamper([&](hid_t file) {
      put(file, (std::string("/particles/grains/") + field + "/value").c_str(), entry, value);
    });
    return complaint_of_all(Verify::no);
  };
  const auto sentence = [&](const char* field, const char* what) {
    return path + ": /particles/grains/" + field + "/value of grain 1 in frame 1 is " + what +
           "; the frame is damaged";
  };
  const char* number = "not NaN, although the position marks the grain as absent";
  EXPECT_EQ(complaint_of("velocity", 6 + 2, 0.5), sentence("velocity", number));
  EXPECT_EQ(complaint_of("force", 6 + 3, 0.5), sentence("force", number));
  EXPECT_EQ(complaint_of("position", 6 + 2, 0.5), sentence("position", number));
  EXPECT_EQ(complaint_of("position", 6 + 3, 0.5), sentence("position", "not finite"));
  EXPECT_EQ(complaint_of("angular_velocity", 3 + 1, 0.5), sentence("angular_velocity", number));
  EXPECT_EQ(complaint_of("velocity", 3, nan), path +
                                                  ": /particles/grains/velocity/value of grain 1 "
                                                  "in frame 0 is not finite; the frame is "
                                                  "damaged");
}

TEST_F(AbsentGrains, AContactThatNamesOneIsRefused)
{
  auto frame = three_grains::frame(1);
  make_absent(frame, 1);
  write(frame);
  EXPECT_EQ(complaint(),
            path + ": contact 0 of frame 1 names grain 1, which is absent in this frame");
}

TEST_F(AbsentGrains, LeaveTheBytesOfOtherRunsAlone)
{
  three_grains::write(path, 2);
  const TrajectoryReader run(path);
  EXPECT_FALSE(run.grains_come_and_go());
}

}  // namespace
}  // namespace grseg
