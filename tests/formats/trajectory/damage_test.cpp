// SPDX-License-Identifier: GPL-3.0-or-later
// Damaged and foreign files are refused with one message.
#include "tests/formats/trajectory/trajectory_fixture.hpp"

#include <sys/wait.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <utility>

namespace grseg {
namespace {

// HDF5 reads such structures repeatedly, in case their writer is about to complete them.
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
  for (const auto& changed : std::initializer_list<Change>{
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
    tamper([&](hid_t file) { add_to(file, changed.dataset, changed.entry, changed.by); });
    EXPECT_TRUE(complaint_of_all().starts_with(path + ": " + changed.place)) << complaint_of_all();
    EXPECT_NE(complaint_of_all().find(" not what was written: the file is damaged"),
              std::string::npos);
    EXPECT_EQ(complaint_of_all(Verify::no), "no complaint") << changed.dataset;
  }
}

TEST_F(Trajectory, AFrameThatStandsInThePlaceOfAnotherIsNamed)
{
  three_grains::write(path, 3);
  tamper([](hid_t file) {  // as if an index pointed to the chunk of another frame
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
                             ": /grseg/seal does not agree with the frames or the summary in the "
                             "file: the file is damaged; use an intact copy");
}

TEST_F(Trajectory, WhatIsKnownAtTheEndIsSealed)
{
  TrajectoryWriter writer(path, three_grains::description());
  writer.append(three_grains::frame(0), std::vector<double>{0});
  writer.add_parameters({{{"summary_mean_gap", {1e-5}}}, {}});
  writer.close();
  EXPECT_EQ(TrajectoryReader(path).parameters().number("summary_mean_gap", path), 1e-5);
  tamper([](hid_t file) { add_to(file, "/parameters/summary_mean_gap", 0, 1); });
  EXPECT_NE(complaint().find("/grseg/seal does not agree"), std::string::npos);
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

TEST_F(Trajectory, AFileOfAnotherVersionIsRefused)
{
  for (const auto& [major, minor] : {std::pair{0, 9}, {1, 1}, {2, 0}}) {
    three_grains::write(path, 1);
    tamper([&](hid_t file) {
      const hid_t group = H5Gopen2(file, "/h5md/modules/grseg", H5P_DEFAULT);
      const hid_t attribute = H5Aopen(group, "version", H5P_DEFAULT);
      const int version[2] = {major, minor};
      H5Awrite(attribute, H5T_NATIVE_INT, version);
      H5Aclose(attribute);
      H5Gclose(group);
    });
    EXPECT_EQ(complaint(), path + ": /h5md/modules/grseg has version " + std::to_string(major) +
                               "." + std::to_string(minor) +
                               ", but this grseg reads version 1.0: read the file with the grseg "
                               "that wrote it");
  }
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
  // Stored bytes of the first x of the second frame.
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
