// SPDX-License-Identifier: GPL-3.0-or-later
// Data that are written are read back, also after a kill and while the run continues.
#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/layout.hpp"
#include "formats/trajectory/writer.hpp"
#include "tests/formats/trajectory/trajectory_fixture.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>

#include <cmath>
#include <csignal>
#include <fstream>

namespace grseg {
namespace {

TEST_F(Trajectory, WhatIsWrittenIsReadBackToTheLastBit)
{
  three_grains::write(path, 3);
  const TrajectoryReader reader(path);
  ASSERT_EQ(reader.size(), 3u);
  EXPECT_EQ(reader.grains().id, three_grains::grains().id);
  EXPECT_EQ(reader.grains().species, three_grains::grains().species);
  EXPECT_EQ(reader.grains().radius, three_grains::grains().radius);
  EXPECT_EQ(reader.grains().mass, three_grains::grains().mass);
  EXPECT_EQ(reader.grains().fixed, three_grains::grains().fixed);
  EXPECT_EQ(reader.box().length_x, 0.35);
  EXPECT_TRUE(reader.box().periodic_x);
  EXPECT_EQ(reader.gravity<2>().start, Vec2(3.8, -9.0));
  EXPECT_EQ(reader.parameters().text("history"), "three grains by hand");
  EXPECT_EQ(reader.observable("translational_energy"), (std::vector<double>{0, 0.5, 1}));
  Frame<2> frame;
  for (std::size_t k = 0; k < 3; ++k) {
    reader.read(k, frame, {.velocity = true, .contacts = true, .force = true});
    expect_same(frame, three_grains::frame(static_cast<std::int64_t>(k)));
  }
}

TEST(Layout, IsOneTableInAllTranslationUnits)
{
  EXPECT_EQ(&row_at(layout.front().path), &layout.front());
}

TEST_F(Trajectory, CompressionChangesNoNumberAndNoDigest)
{
  three_grains::write(path, 2, {.compression = 0});
  const auto plain = TrajectoryReader(path).digest();
  three_grains::write(path, 2, {.compression = 9});
  const TrajectoryReader reader(path);
  EXPECT_EQ(reader.digest(), plain);
  Frame<2> frame;
  reader.read(1, frame, {.velocity = true, .contacts = true, .force = true});
  expect_same(frame, three_grains::frame(1));
}

TEST_F(Trajectory, RepackingKeepsEveryNumberAndTheDigest)
{
  const std::string packed = path + ".packed";
  three_grains::write(path, 3);
  repack(path, packed, {.compression = 9});
  {
    const TrajectoryReader before(path), after(packed);
    ASSERT_EQ(after.size(), 3u);
    EXPECT_EQ(after.digest(), before.digest());
    EXPECT_EQ(after.grains().mass, before.grains().mass);
    EXPECT_EQ(after.parameters().numbers, before.parameters().numbers);
    EXPECT_EQ(after.parameters().texts, before.parameters().texts);
    EXPECT_EQ(after.observable("translational_energy"), before.observable("translational_energy"));
    EXPECT_EQ(after.observables()[0].unit, "J");
    Frame<2> frame;
    after.read(2, frame, {.velocity = true, .contacts = true, .force = true});
    expect_same(frame, three_grains::frame(2));
  }
  fs::remove(packed);

  three_grains::write(path, 2, {.float32 = true});
  repack(path, packed, {.compression = 1, .float32 = true});
  EXPECT_EQ(TrajectoryReader(packed).digest(), TrajectoryReader(path).digest());
  fs::remove(packed);
}

TEST_F(Trajectory, SinglePrecisionKeepsSevenDigits)
{
  three_grains::write(path, 1, {.float32 = true});
  Frame<2> frame;
  TrajectoryReader(path).read(0, frame);
  EXPECT_NEAR(frame.contacts.force[1].y(), 1e-3, 1e-10);
  EXPECT_NE(frame.contacts.force[1].y(), 1e-3);
}

TEST_F(Trajectory, TheDigestShowsAnyChangeInAnyFrame)
{
  three_grains::write(path, 2);
  const auto digest = TrajectoryReader(path).digest();
  const auto first = frame_digest(three_grains::frame(0), 0, false);
  EXPECT_EQ(digest, frame_digest(three_grains::frame(1), first, false));
  auto other = three_grains::frame(0);
  other.contacts.force[0].x() = std::nextafter(other.contacts.force[0].x(), 1);
  EXPECT_NE(frame_digest(other, 0, false), first);
}

TEST_F(Trajectory, AnInterruptedFrameIsInvisible)
{
  write_unfinished(3);
  // State of the file if a run stops between the rows of a frame and its entry in `offset`.
  tamper([](hid_t file) {
    const hid_t id = H5Dopen2(file, "/grseg/contacts/offset", H5P_DEFAULT);
    const hsize_t entries = 3;
    H5Dset_extent(id, &entries);
    H5Dclose(id);
  });
  const TrajectoryReader reader(path);
  ASSERT_EQ(reader.size(), 2u);
  EXPECT_EQ(reader.times().size(), 2u);
  Frame<2> frame;
  reader.read(1, frame);
  EXPECT_EQ(frame.contacts.force, three_grains::frame(1).contacts.force);
}

TEST_F(Trajectory, AWriterKilledAtAnyTimeLeavesWholeFrames)
{
  for (const int frames_before_death : {1, 2, 7, 30}) {
    const pid_t child = fork();
    if (child == 0) {
      TrajectoryWriter writer(path, three_grains::description(), {.live = true});
      for (int k = 0; k < frames_before_death; ++k)
        writer.append(three_grains::frame(k), std::vector<double>{0});
      std::raise(SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    const TrajectoryReader reader(path);
    EXPECT_EQ(reader.size(), static_cast<std::size_t>(frames_before_death));
    EXPECT_FALSE(reader.closed());
    Frame<2> frame;
    for (std::size_t k = 0; k < reader.size(); ++k) {
      reader.read(k, frame, {.velocity = true, .contacts = true, .force = true});
      expect_same(frame, three_grains::frame(static_cast<std::int64_t>(k)));
    }
  }
}

TEST_F(Trajectory, AWriterKilledInTheMiddleOfAFrameLeavesAllFramesBeforeIt)
{
  for (int trial = 0; trial < 20; ++trial) {
    int done[2];
    ASSERT_EQ(pipe(done), 0);
    const pid_t child = fork();
    if (child == 0) {
      TrajectoryWriter writer(path, three_grains::description(), {.live = true});
      for (std::int64_t k = 0;; ++k) {
        writer.append(three_grains::frame(k), std::vector<double>{0});
        if (write(done[1], "x", 1) != 1) _exit(1);
      }
    }
    close(done[1]);
    char byte = 0;
    ASSERT_EQ(read(done[0], &byte, 1), 1);
    usleep(static_cast<useconds_t>(1000 + 1371 * trial));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    std::size_t appended = 1;
    while (read(done[0], &byte, 1) == 1) ++appended;
    close(done[0]);
    const TrajectoryReader reader(path);
    EXPECT_GE(reader.size(), appended);
    EXPECT_LE(reader.size(), appended + 1);
    Frame<2> frame;
    for (std::size_t k = 0; k < reader.size(); ++k) {
      reader.read(k, frame, {.velocity = true, .contacts = true, .force = true});
      expect_same(frame, three_grains::frame(static_cast<std::int64_t>(k)));
    }
  }
}

TEST_F(Trajectory, ARunThatGoesOnCanBeRead)
{
  int written[2], go_on[2];
  ASSERT_EQ(pipe(written), 0);
  ASSERT_EQ(pipe(go_on), 0);
  const pid_t child = fork();
  if (child == 0) {
    char byte = 0;
    TrajectoryWriter writer(path, three_grains::description(), {.live = true});
    for (int k = 0; k < 3; ++k) {
      writer.append(three_grains::frame(k), std::vector<double>{0.5 * k});
      if (write(written[1], "x", 1) != 1 || read(go_on[0], &byte, 1) != 1) _exit(1);
    }
    writer.close();
    _exit(0);
  }
  for (int k = 0; k < 3; ++k) {
    char byte = 0;
    ASSERT_EQ(read(written[0], &byte, 1), 1);
    const TrajectoryReader reader(path);
    EXPECT_FALSE(reader.closed());
    EXPECT_EQ(reader.size(), static_cast<std::size_t>(k + 1));
    Frame<2> frame;
    reader.read(reader.size() - 1, frame);
    EXPECT_EQ(frame.contacts.force, three_grains::frame(k).contacts.force);
    EXPECT_EQ(reader.observable("translational_energy").back(), 0.5 * k);
    ASSERT_EQ(write(go_on[1], "x", 1), 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  for (const int end : {written[0], written[1], go_on[0], go_on[1]}) close(end);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(TrajectoryReader(path).closed());
}

TEST_F(Trajectory, TheSameRunGivesTheSameBytes)
{
  const auto bytes = [&] {
    three_grains::write(path, 3);
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const auto first = bytes();
  usleep(1100000);  // object times have a resolution of whole seconds
  EXPECT_EQ(bytes(), first);
}

TEST_F(Trajectory, ARunThatIsBeingWrittenIsReportedAsSuch)
{
  three_grains::write(path, 1);
  const int file = open(path.c_str(), O_RDWR);
  ASSERT_EQ(flock(file, LOCK_EX), 0);  // HDF5 holds this lock while it writes
  EXPECT_EQ(complaint(),
            path + ": is being written by a run; wait until the run has ended, or read a copy");
  close(file);
  EXPECT_EQ(complaint(), "no complaint");
}

TEST_F(Trajectory, AFrameWithoutContactsIsAFrame)
{
  auto falling = three_grains::frame(0);
  falling.contacts.clear();
  {
    TrajectoryWriter writer(path, three_grains::description());
    writer.append(falling, std::vector<double>{0});
    writer.close();
  }
  Frame<2> frame;
  const TrajectoryReader reader(path);
  ASSERT_EQ(reader.size(), 1u);
  reader.read(0, frame);
  EXPECT_EQ(frame.contacts.size(), 0u);
}

}  // namespace
}  // namespace grseg
