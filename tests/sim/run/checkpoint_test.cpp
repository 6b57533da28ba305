// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/checkpoint.hpp"

#include "formats/core/errors.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace grseg {
namespace {

namespace fs = std::filesystem;

class CheckpointFile : public testing::Test {
 protected:
  std::string path =
      (fs::temp_directory_path() / ("grseg_checkpoint_test_" + std::to_string(getpid()) + ".chk"))
          .string();
  Scene scene = small_chute::scene({"--base", "wall", "--lateral", "walls"});
  void SetUp() override
  {
    auto simulation = small_chute::bed(scene);
    for (int k = 0; k < 50; ++k) simulation.advance();
    written = small_chute::checkpoint_of(simulation, scene);
    write_checkpoint(path, written);
  }
  void TearDown() override { fs::remove(path); }

  template <class Damage>
  void tamper(Damage damage) const
  {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    damage(file);
    H5Fclose(file);
  }
  template <class T>
  static void put(hid_t file, const char* dataset, hid_t type, T value)
  {
    const hid_t id = H5Dopen2(file, dataset, H5P_DEFAULT);
    H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value);
    H5Dclose(id);
  }
  std::string complaint() const
  {
    try {
      read_checkpoint(path);
    } catch (const FormatError& error) {
      return error.what();
    }
    return "no complaint";
  }
  Checkpoint written;
};

std::vector<double> numbers_of(const StepTotals& t)
{
  return {static_cast<double>(t.steps),
          static_cast<double>(t.missed),
          t.sweeps,
          t.residual_rms,
          t.touching,
          t.force_bearing,
          t.sum_overlap,
          t.sum_gap_bearing,
          t.largest_residual,
          t.largest_overlap,
          t.fastest_approach,
          t.base_impulse.x(),
          t.base_impulse.y()};
}

TEST_F(CheckpointFile, WhatIsWrittenIsReadBackToTheLastBit)
{
  const auto read = read_checkpoint(path);
  EXPECT_EQ(read.scene, written.scene);
  EXPECT_EQ(read.program, "a test");
  EXPECT_EQ(read.history, "first\nsecond");
  EXPECT_EQ(read.deposited_height, 1.0 / 7);
  EXPECT_EQ(read.grains.id, written.grains.id);
  EXPECT_EQ(read.grains.species, written.grains.species);
  EXPECT_EQ(read.grains.radius, written.grains.radius);
  EXPECT_EQ(read.grains.mass, written.grains.mass);
  EXPECT_EQ(read.grains.fixed, written.grains.fixed);
  ASSERT_EQ(read.walls.size(), 3u);
  EXPECT_EQ(read.walls[2].point, written.walls[2].point);
  EXPECT_EQ(read.walls[2].normal, Vec2(-1, 0));
  EXPECT_EQ(read.box.length_y, written.box.length_y);
  EXPECT_FALSE(read.box.periodic_x);
  EXPECT_EQ(read.state.position, written.state.position);
  EXPECT_EQ(read.state.image, written.state.image);
  EXPECT_EQ(read.state.velocity, written.state.velocity);
  EXPECT_EQ(read.state.rim_speed, written.state.rim_speed);
  EXPECT_EQ(read.state.row, written.state.row);
  EXPECT_EQ(read.state.steps_done, 50);
  EXPECT_EQ(read.state.pairs.made_at, written.state.pairs.made_at);
  EXPECT_EQ(read.state.pairs.i, written.state.pairs.i);
  EXPECT_EQ(read.state.pairs.j, written.state.pairs.j);
  EXPECT_EQ(read.state.pairs.impulse_n, written.state.pairs.impulse_n);
  EXPECT_EQ(read.state.pairs.impulse_t, written.state.pairs.impulse_t);
  EXPECT_EQ(read.state.pairs.approach, written.state.pairs.approach);
  EXPECT_EQ(read.state.pairs.renewals, written.state.pairs.renewals);
  EXPECT_EQ(read.state.pairs.age, written.state.pairs.age);
  EXPECT_EQ(read.trajectory.frames, 3u);
  EXPECT_EQ(read.trajectory.digest, 0xfedcba9876543210);
  EXPECT_EQ(read.trajectory.begin, 0.25);
  EXPECT_EQ(read.trajectory.wall, 1.5);
  EXPECT_EQ(numbers_of(read.trajectory.recorder.since_frame),
            (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 1.0 / 3}));
  EXPECT_EQ(numbers_of(read.trajectory.recorder.totals),
            numbers_of(written.trajectory.recorder.totals));
}

TEST_F(CheckpointFile, EveryTruncationIsRefused)
{
  std::ifstream file(path, std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(file), {});
  for (std::size_t length = 0; length < whole.size(); length += 997) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << whole.substr(0, length);
    EXPECT_EQ(complaint(), path + ": is not a checkpoint, or is truncated or damaged") << length;
  }
}

TEST_F(CheckpointFile, AChangedNumberIsToldByTheDigest)
{
  tamper([](hid_t file) {
    put(file, "/trajectory/since_frame/base_impulse_x", H5T_NATIVE_DOUBLE, 0.1000001);
  });
  EXPECT_EQ(complaint(), path +
                             ": does not have the content that its digest names: it is damaged; "
                             "use an older checkpoint");
}

TEST_F(CheckpointFile, AnotherVersionIsRefused)
{
  for (const int version : {1, 99}) {
    tamper([&](hid_t file) { put(file, "/version", H5T_NATIVE_INT, version); });
    EXPECT_EQ(complaint(), path + ": is a checkpoint of version " + std::to_string(version) +
                               ", and this grseg-sim reads version 2; continue with the "
                               "program that wrote it");
  }
}

TEST_F(CheckpointFile, AMissingEntryIsNamed)
{
  tamper([](hid_t file) { H5Ldelete(file, "/state/rim_speed", H5P_DEFAULT); });
  EXPECT_EQ(complaint(), path + ": /state/rim_speed is missing");
}

TEST_F(CheckpointFile, AnotherHdf5FileIsNoCheckpoint)
{
  H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_EQ(complaint(),
            path + ": is not a checkpoint of grseg-sim; name the file that --checkpoint wrote");
}

TEST_F(CheckpointFile, AMissingFileIsAUsageError)
{
  EXPECT_THROW(read_checkpoint("/nowhere/run.chk"), UsageError);
}

TEST_F(CheckpointFile, OneThatCannotBeWrittenLeavesTheOldOneWhole)
{
  fs::create_directory(path + ".part");  // in the way of the new one
  EXPECT_THROW(write_checkpoint(path, written), RunError);
  fs::remove(path + ".part");
  EXPECT_EQ(complaint(), "no complaint");
}

}  // namespace
}  // namespace grseg
