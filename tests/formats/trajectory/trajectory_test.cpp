// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/reader.hpp"
#include "formats/trajectory/repack.hpp"
#include "tests/three_grains.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace grseg {
namespace {

namespace fs = std::filesystem;

class Trajectory : public testing::Test {
 protected:
  std::string path =
      (fs::temp_directory_path() / ("grseg_trajectory_test_" + std::to_string(getpid()) + ".h5"))
          .string();
  void TearDown() override { fs::remove(path); }

  /// Opens the file for damage and hands it to `damage`.
  template <class Damage>
  void tamper(Damage damage)
  {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    damage(file);
    H5Fclose(file);
  }
  static void put(hid_t file, const char* dataset, hsize_t flat, double value)
  {
    const hid_t id = H5Dopen2(file, dataset, H5P_DEFAULT);
    const hid_t space = H5Dget_space(id);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    values.at(flat) = value;
    H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(id);
  }
  static void add_to(hid_t file, const char* dataset, hsize_t flat, double value)
  {
    const hid_t id = H5Dopen2(file, dataset, H5P_DEFAULT);
    const hid_t space = H5Dget_space(id);
    const hid_t type = H5Dget_type(id);
    const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
    if (H5Tget_class(type) == H5T_INTEGER) {
      std::vector<std::uint64_t> values(count);
      H5Dread(id, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      values.at(flat) ^= static_cast<std::uint64_t>(value);
      H5Dwrite(id, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    } else {
      std::vector<double> values(count);
      H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      values.at(flat) += value;
      H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    }
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(id);
  }
  /// A run that was not closed.
  void write_unfinished(int frames) const
  {
    TrajectoryWriter writer(path, three_grains::description());
    for (int k = 0; k < frames; ++k) writer.append(three_grains::frame(k), std::vector<double>{0});
  }
  std::string complaint(TrajectoryReader::Fields fields = {}, Verify verify = Verify::yes) const
  {
    try {
      const TrajectoryReader reader(path, verify);
      Frame<2> frame;
      for (std::size_t k = 0; k < reader.size(); ++k) reader.read(k, frame, fields);
      if (fields.force) reader.observable("translational_energy");
    } catch (const FormatError& error) {
      return error.what();
    }
    return "no complaint";
  }
  std::string complaint_of_all(Verify verify = Verify::yes) const
  {
    return complaint({.velocity = true, .contacts = true, .force = true}, verify);
  }
  const std::string changed =
      " is not what was written: the file is damaged; take a copy that is whole, or leave the frame "
      "out with --begin or --end";
};

void expect_same(const Frame<2>& a, const Frame<2>& b)
{
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.image, b.image);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.angular_velocity, b.angular_velocity);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.contacts.i, b.contacts.i);
  EXPECT_EQ(a.contacts.j, b.contacts.j);
  EXPECT_EQ(a.contacts.force, b.contacts.force);
  EXPECT_EQ(a.contacts.branch, b.contacts.branch);
  EXPECT_EQ(a.contacts.gap, b.contacts.gap);
}

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
  // What a run leaves that stops between the rows of a frame and its entry in `offset`.
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

TEST_F(Trajectory, AWriterKilledAtAnyMomentLeavesWholeFrames)
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

// HDF5 reads such structures again and again, in case that their writer is about to complete them.
TEST_F(Trajectory, ADamagedStructureOfARunThatWasKilledIsNamedAtOnce)
{
  const pid_t child = fork();
  if (child == 0) {
    TrajectoryWriter writer(path, three_grains::description(), {.live = true});
    for (int k = 0; k < 3; ++k) writer.append(three_grains::frame(k), std::vector<double>{0});
    std::raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  std::ifstream file(path, std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(file), {});
  int damaged = 0;
  for (const char* structure : {"OHDR", "EAHD", "EAIB"}) {  // object header, index of chunks
    auto bytes = whole;
    const auto at = bytes.rfind(structure);
    ASSERT_NE(at, std::string::npos);
    bytes[at + 12] = static_cast<char>(bytes[at + 12] ^ 4);
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    alarm(20);
    damaged += complaint_of_all() != "no complaint" ? 1 : 0;
    alarm(0);
  }
  EXPECT_EQ(damaged, 3);
}

// Version 1.0 was written so that a kill could leave the last frames damaged.
TEST_F(Trajectory, ADamagedLastFrameOfAnUnfinishedRunOfVersion1_0IsLeftOut)
{
  fs::copy_file(std::string(GRSEG_TEST_INPUTS) + "/three-grains-1.0.h5", path);
  const auto frames = TrajectoryReader(path).size();
  const auto last = 6 * (frames - 1) + 1;
  tamper([&](hid_t file) { put(file, "/particles/grains/position/value", last, 0); });
  const TrajectoryReader reader(path);
  EXPECT_EQ(reader.size(), frames - 1);
  EXPECT_EQ(reader.steps().size(), frames - 1);
}

TEST_F(Trajectory, ADamagedLastFrameOfAnUnfinishedRunIsNamed)
{
  write_unfinished(3);
  tamper([](hid_t file) { put(file, "/particles/grains/position/value", 2 * 6 + 1, 0); });
  EXPECT_EQ(complaint(), path + ": /particles/grains/position of frame 2" + changed);
}

struct Change {
  const char* dataset;
  hsize_t entry;
  std::string place;
  double by = 1;
};

TEST_F(Trajectory, OneOtherNumberAnywhereIsNamed)
{
  const std::string once = "box, grains, species, observables or parameters are";
  const std::string place =
      "/particles/grains/position/step, time or its rows of contacts of frame 1";
  for (const auto& [dataset, entry, what, by] : std::initializer_list<Change>{
           {"/particles/grains/radius", 1, once},
           {"/particles/grains/mass", 0, once},
           {"/particles/grains/species", 1, once},
           {"/particles/grains/fixed", 2, once},
           {"/particles/grains/id", 0, once},
           {"/particles/grains/box/edges", 1, once},
           {"/parameters/gravity", 1, once},
           {"/parameters/density", 0, once},
           {"/grseg/static_digest", 0, once},
           {"/particles/grains/position/step", 1, place},
           {"/particles/grains/position/time", 1, place, 1e-9},
           {"/grseg/digest", 1, place},
           {"/grseg/field_digest", 12, place},
           {"/particles/grains/position/value", 7, "/particles/grains/position of frame 1"},
           {"/particles/grains/image/value", 7, "/particles/grains/image of frame 1"},
           {"/particles/grains/velocity/value", 7, "/particles/grains/velocity of frame 1"},
           {"/particles/grains/angular_velocity/value", 4,
            "/particles/grains/angular_velocity of frame 1"},
           {"/particles/grains/force/value", 7, "/particles/grains/force of frame 1"},
           {"/grseg/contacts/i", 3, "/grseg/contacts/i of frame 1"},
           {"/grseg/contacts/j", 3, "/grseg/contacts/j of frame 1", 3},
           {"/grseg/contacts/force", 5, "/grseg/contacts/force of frame 1"},
           {"/grseg/contacts/branch", 5, "/grseg/contacts/branch of frame 1"},
           {"/grseg/contacts/gap", 2, "/grseg/contacts/gap of frame 1"},
           {"/observables/translational_energy/value", 1, "/observables of frame 1"}}) {
    three_grains::write(path, 3);
    tamper([&](hid_t file) { add_to(file, dataset, entry, by); });
    EXPECT_TRUE(complaint_of_all().starts_with(path + ": " + what)) << complaint_of_all();
    EXPECT_NE(complaint_of_all().find(" not what was written: the file is damaged"),
              std::string::npos);
    EXPECT_EQ(complaint_of_all(Verify::no), "no complaint") << dataset;
  }
}

TEST_F(Trajectory, AFrameThatStandsInThePlaceOfAnotherIsNamed)
{
  three_grains::write(path, 3);
  tamper([](hid_t file) {  // as where an index leads to the chunk of another frame
    const hid_t id = H5Dopen2(file, "/particles/grains/position/value", H5P_DEFAULT);
    std::vector<double> values(18);
    H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    std::swap_ranges(values.begin(), values.begin() + 6, values.begin() + 6);
    H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(id);
  });
  EXPECT_EQ(complaint(), path + ": /particles/grains/position of frame 0" + changed);
}

TEST_F(Trajectory, AClosedFileThatLostItsLastFramesIsRefused)
{
  three_grains::write(path, 3);
  tamper([](hid_t file) {
    const hid_t id = H5Dopen2(file, "/grseg/contacts/offset", H5P_DEFAULT);
    const hsize_t entries = 3;
    H5Dset_extent(id, &entries);
    H5Dclose(id);
  });
  EXPECT_EQ(complaint(), path +
                             ": /grseg/seal names other frames or another summary than the file "
                             "holds: the file is damaged; take a copy that is whole");
}

TEST_F(Trajectory, WhatIsKnownAtTheEndIsSealed)
{
  TrajectoryWriter writer(path, three_grains::description());
  writer.append(three_grains::frame(0), std::vector<double>{0});
  writer.add_parameters({{{"summary_mean_gap", {1e-5}}}, {}});
  writer.close();
  EXPECT_EQ(TrajectoryReader(path).parameters().number("summary_mean_gap", path), 1e-5);
  tamper([](hid_t file) { add_to(file, "/parameters/summary_mean_gap", 0, 1); });
  EXPECT_NE(complaint().find("/grseg/seal names"), std::string::npos);
}

TEST_F(Trajectory, AFieldThatIsNotReadNeedNotBeWhole)
{
  three_grains::write(path, 2);
  tamper([](hid_t file) { add_to(file, "/particles/grains/velocity/value", 0, 1); });
  const TrajectoryReader reader(path);
  Frame<2> frame;
  reader.read(0, frame, {.velocity = false, .contacts = true, .force = false});
  EXPECT_THROW(reader.read(0, frame), FormatError);
  EXPECT_EQ(reader.verified(), "all");
}

TEST_F(Trajectory, OfVersion1_0FramesAreVerified)
{
  fs::copy_file(std::string(GRSEG_TEST_INPUTS) + "/three-grains-1.0.h5", path);
  EXPECT_EQ(TrajectoryReader(path).verified(), "frames only");
  tamper([](hid_t file) { add_to(file, "/grseg/contacts/force", 0, 1); });
  EXPECT_EQ(complaint(), path + ": frame 0" + changed);
}

TEST_F(Trajectory, AFileOfANewerMajorVersionIsRefused)
{
  three_grains::write(path, 1);
  tamper([](hid_t file) {
    const hid_t group = H5Gopen2(file, "/h5md/modules/grseg", H5P_DEFAULT);
    const hid_t attribute = H5Aopen(group, "version", H5P_DEFAULT);
    const int version[2] = {2, 0};
    H5Awrite(attribute, H5T_NATIVE_INT, version);
    H5Aclose(attribute);
    H5Gclose(group);
  });
  EXPECT_EQ(complaint(),
            path + ": /h5md/modules/grseg has version 2.0, but this grseg reads versions 1.x");
}

TEST_F(Trajectory, TheSameRunGivesTheSameBytes)
{
  const auto bytes = [&] {
    three_grains::write(path, 3);
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const auto first = bytes();
  usleep(1100000);  // object times would be in whole seconds
  EXPECT_EQ(bytes(), first);
}

TEST_F(Trajectory, ARunThatIsBeingWrittenIsReportedAsSuch)
{
  three_grains::write(path, 1);
  const int file = open(path.c_str(), O_RDWR);
  ASSERT_EQ(flock(file, LOCK_EX), 0);  // as HDF5 does while it writes
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

TEST_F(Trajectory, EveryTruncationIsRefusedOrReadsWholeFrames)
{
  three_grains::write(path, 3, {.compression = 0});
  std::ifstream file(path, std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(file), {});
  for (std::size_t length = 0; length < whole.size(); length += 997) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << whole.substr(0, length);
    try {
      const TrajectoryReader reader(path);
      Frame<2> frame;
      for (std::size_t k = 0; k < reader.size(); ++k) {
        reader.read(k, frame);
        EXPECT_EQ(frame.position, three_grains::frame(static_cast<std::int64_t>(k)).position);
      }
    } catch (const FormatError& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
    }
  }
}

TEST_F(Trajectory, ANanIsReportedWithItsFrame)
{
  three_grains::write(path, 2);
  tamper([](hid_t file) { put(file, "/grseg/contacts/force", 5, std::nan("")); });
  EXPECT_EQ(complaint(), path +
                             ": /grseg/contacts/force is not a finite number in frame 1, entry 1; "
                             "the frame is damaged");
}

TEST_F(Trajectory, AContactWithAMissingGrainIsRefused)
{
  three_grains::write(path, 2);
  tamper([](hid_t file) { put(file, "/grseg/contacts/j", 0, 99); });
  EXPECT_EQ(complaint(),
            path + ": contact 0 of frame 0 joins grains 0 and 99, which is impossible");
}

TEST_F(Trajectory, DecreasingOffsetsAreRefused)
{
  three_grains::write(path, 2);
  tamper([](hid_t file) { put(file, "/grseg/contacts/offset", 1, 9); });
  EXPECT_EQ(complaint(), path + ": /grseg/contacts/offset does not increase from 0 at entry 2");
}

TEST_F(Trajectory, OffsetsBeyondTheRowsAreRefused)
{
  three_grains::write(path, 1);
  tamper([](hid_t file) { put(file, "/grseg/contacts/offset", 1, 1e15); });
  EXPECT_EQ(complaint(), path +
                             ": /grseg/contacts/i has 2 entries along dimension 0, but at least "
                             "1000000000000000 are needed");
}

TEST_F(Trajectory, AMissingDatasetIsNamed)
{
  three_grains::write(path, 1);
  tamper([](hid_t file) { H5Ldelete(file, "/particles/grains/mass", H5P_DEFAULT); });
  EXPECT_EQ(complaint(), path + ": /particles/grains/mass is missing");
}

TEST_F(Trajectory, AFileThatIsNotHdf5IsRefused)
{
  std::ofstream(path) << "not HDF5";
  EXPECT_EQ(complaint(), path + ": is not an HDF5 file, or is truncated or damaged");
}

TEST_F(Trajectory, AMissingFileIsAUsageError)
{
  EXPECT_THROW(TrajectoryReader("/nowhere/run.h5"), UsageError);
}

TEST_F(Trajectory, ADamagedChunkFailsItsChecksum)
{
  three_grains::write(path, 2, {.compression = 0});
  // The stored bytes of the second frame's first x.
  const double x = three_grains::frame(1).position[0].x();
  std::string pattern(reinterpret_cast<const char*>(&x), sizeof x), whole;
  {
    std::ifstream file(path, std::ios::binary);
    whole.assign(std::istreambuf_iterator<char>(file), {});
  }
  const auto at = whole.find(pattern);
  ASSERT_NE(at, std::string::npos);
  whole[at] = static_cast<char>(whole[at] ^ 1);
  std::ofstream(path, std::ios::binary | std::ios::trunc) << whole;
  EXPECT_NE(complaint().find("damaged"), std::string::npos);
}

}  // namespace
}  // namespace grseg
