// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/checkpoint.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "sim/run/restart.hpp"
#include "sim/run/run_files.hpp"
#include "tests/sim/small_chute.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

namespace grseg {
namespace {

namespace fs = std::filesystem;

class CheckpointFile : public testing::Test {
 protected:
  std::string path =
      (fs::temp_directory_path() / ("grseg_checkpoint_test_" + std::to_string(getpid()) + ".chk"))
          .string();
  std::string previous = previous_of(path);
  Scene scene = small_chute::scene({"--base", "wall", "--lateral", "walls"});
  void SetUp() override
  {
    auto simulation = small_chute::bed(scene);
    for (int k = 0; k < 50; ++k) simulation.advance();
    written = small_chute::checkpoint_of(simulation, scene);
    write_checkpoint(path, written);
  }
  void TearDown() override
  {
    fs::remove(path);
    fs::remove(previous);
  }

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
  Checkpoint<2> written;
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
          t.farthest_approach,
          static_cast<double>(t.divided),
          static_cast<double>(t.solved_again),
          t.largest_impulses,
          t.missed_impulse,
          t.missed_gain,
          t.missed_overlap,
          static_cast<double>(t.last_missed),
          t.base_impulse.x(),
          t.base_impulse.y()};
}

TEST_F(CheckpointFile, HasNoTimeOfDay)
{
  const hdf5::File file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  H5O_info_t root;
  ASSERT_GE(H5Oget_info(file, &root), 0);
  EXPECT_EQ(root.ctime, 0);
}

TEST_F(CheckpointFile, WhatIsWrittenIsReadBackToTheLastBit)
{
  const auto read = std::get<Checkpoint<2>>(read_checkpoint(path));
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
  EXPECT_EQ(read.state.rim, written.state.rim);
  EXPECT_EQ(read.state.row, written.state.row);
  EXPECT_EQ(read.state.held_back, written.state.held_back);
  EXPECT_EQ(read.state.stored, written.state.stored);
  EXPECT_EQ(read.state.steps_done, 50);
  EXPECT_EQ(read.state.pairs.made_at, written.state.pairs.made_at);
  EXPECT_EQ(read.state.pairs.i, written.state.pairs.i);
  EXPECT_EQ(read.state.pairs.j, written.state.pairs.j);
  EXPECT_EQ(read.state.pairs.impulse_n, written.state.pairs.impulse_n);
  EXPECT_EQ(read.state.pairs.impulse_t, written.state.pairs.impulse_t);
  EXPECT_EQ(read.state.pairs.approach, written.state.pairs.approach);
  EXPECT_EQ(read.state.pairs.skin, written.state.pairs.skin);
  EXPECT_EQ(read.state.pairs.renewals, written.state.pairs.renewals);
  EXPECT_EQ(read.trajectory.frames, 3u);
  EXPECT_EQ(read.trajectory.digest, 0xfedcba9876543210);
  EXPECT_EQ(read.trajectory.begin, 0.25);
  EXPECT_EQ(read.trajectory.wall, 1.5);
  EXPECT_EQ(numbers_of(read.trajectory.recorder.since_frame),
            (std::vector<double>{1,  2,  3,  4,  5,  6,  7,  8, 9,  10,     11,
                                 12, 13, 14, 16, 17, 18, 19, 1, 15, 1.0 / 3}));
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
                             ": its content disagrees with its digest: it is damaged; "
                             "use an older checkpoint");
}

TEST_F(CheckpointFile, AnotherVersionIsRefused)
{
  for (const int version : {0, 5, 99}) {
    tamper([&](hid_t file) { put(file, "/version", H5T_NATIVE_INT, version); });
    EXPECT_EQ(complaint(),
              path + ": is a checkpoint of version " + std::to_string(version) +
                  ", and this grseg-sim reads version 2; continue with the program that wrote it");
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

TEST_F(CheckpointFile, TheOneBeforeIsKept)
{
  EXPECT_FALSE(fs::exists(previous));
  for (const std::int64_t step : {51, 52, 53}) {
    written.state.steps_done = step;
    write_checkpoint(path, written);
    EXPECT_EQ(std::get<Checkpoint<2>>(read_checkpoint(path)).state.steps_done, step);
    EXPECT_EQ(std::get<Checkpoint<2>>(read_checkpoint(previous)).state.steps_done, step - 1);
  }
}

TEST_F(CheckpointFile, ADamagedOneDoesNotReplaceTheOneBefore)
{
  write_checkpoint(path, written);
  fs::resize_file(path, 1000);
  EXPECT_EQ(complaint(), path + ": is not a checkpoint, or is truncated or damaged; " + previous +
                             " is the previous checkpoint");
  written.state.steps_done = 51;
  write_checkpoint(path, written);
  EXPECT_EQ(std::get<Checkpoint<2>>(read_checkpoint(path)).state.steps_done, 51);
  EXPECT_EQ(std::get<Checkpoint<2>>(read_checkpoint(previous)).state.steps_done, 50);
}

TEST_F(CheckpointFile, WhereItIsMissingTheOneBeforeIsNamed)
{
  fs::rename(path, previous);
  try {
    read_checkpoint(path);
    FAIL();
  } catch (const UsageError& missing) {
    EXPECT_EQ(missing.what(), path + ": no such file; " + previous + " is the previous checkpoint");
  }
}

TEST(PreviousCheckpoint, IsNamedBeforeTheExtension)
{
  EXPECT_EQ(previous_of("run.chk"), "run_prev.chk");
  EXPECT_EQ(previous_of("a.b/run"), "a.b/run_prev");
  EXPECT_EQ(previous_of("../run.h5.chk"), "../run.h5_prev.chk");
}

/// A forged checkpoint with a matching digest: the change, and the expected message.
struct Forgery {
  std::string complaint;
  std::function<void(Checkpoint<2>&)> forge;
};

class ForgedCheckpoint : public CheckpointFile, public testing::WithParamInterface<Forgery> {};

TEST_P(ForgedCheckpoint, IsRefusedByItsEntry)
{
  auto forged = written;
  GetParam().forge(forged);
  fs::remove(path);
  write_checkpoint(path, forged);
  const auto grains = written.grains.size();
  const auto expected = fmt::format(fmt::runtime(GetParam().complaint), fmt::arg("grains", grains),
                                    fmt::arg("fewer", grains - 1));
  EXPECT_EQ(complaint(), path + ": " + expected +
                             ": the file was not written by grseg-sim, or is damaged; use an "
                             "older checkpoint");
}

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    EveryEntry, ForgedCheckpoint,
    testing::Values(
        Forgery{"/state/steps_done is -4611686018427387904, and the run has 375000 steps",
                [](Checkpoint<2>& c) { c.state.steps_done = -(std::int64_t{1} << 62); }},
        Forgery{"/state/steps_done is 375001, and the run has 375000 steps",
                [](Checkpoint<2>& c) { c.state.steps_done = 375'001; }},
        Forgery{"/state/row, entry 3, is not the row of a grain",
                [](Checkpoint<2>& c) { c.state.row[3] = 1'000'000; }},
        Forgery{"/state/row, entry 0, is not the row of a grain",
                [](Checkpoint<2>& c) { c.state.row[0] = -1; }},
        Forgery{
            "/state/row has 0 twice",
            [](Checkpoint<2>& c) { *std::find(c.state.row.begin(), c.state.row.end(), 1) = 0; }},
        Forgery{"/state/row has {fewer} entries for {grains} grains",
                [](Checkpoint<2>& c) { c.state.row.pop_back(); }},
        Forgery{"/grains/species, entry 2, is not -1, 0 or 1",
                [](Checkpoint<2>& c) { c.grains.species[2] = static_cast<Species>(77); }},
        Forgery{"/grains/id has 5 twice",
                [](Checkpoint<2>& c) { c.grains.id[1] = c.grains.id[2] = 5, c.grains.id[5] = -1; }},
        Forgery{"/grains/fixed, entry 1, is not 0 or 1",
                [](Checkpoint<2>& c) { c.grains.fixed[1] = 2; }},
        Forgery{"/grains/radius, entry 0, is not a positive number",
                [](Checkpoint<2>& c) { c.grains.radius[0] = 0; }},
        Forgery{
            "/grains/radius, entry 0, is larger than the diameters of large grains and base grains",
            [](Checkpoint<2>& c) { c.grains.radius[0] = 1e6; }},
        Forgery{"/grains/mass, entry 1, is not a positive number",
                [](Checkpoint<2>& c) { c.grains.mass[1] = -1; }},
        Forgery{"/walls, entry 0, is not a point and a normal of length 1",
                [](Checkpoint<2>& c) { c.walls[0].normal *= 2; }},
        Forgery{"/box/length_x is not a positive number",
                [](Checkpoint<2>& c) {
                  c.box = {0, 1, true};
                }},
        Forgery{"/box/length_y is not a finite number",
                [](Checkpoint<2>& c) { c.box.length_y = no_number; }},
        Forgery{"/deposited_height is not a finite number",
                [](Checkpoint<2>& c) { c.deposited_height = infinite; }},
        Forgery{"/state/position, entry 4, is not a finite number",
                [](Checkpoint<2>& c) { c.state.position[4].y() = no_number; }},
        Forgery{"/state/position, entry 4, is farther than 1e12 d_S from the origin",
                [](Checkpoint<2>& c) { c.state.position[4].x() = 1e300; }},
        Forgery{"/state/velocity, entry 0, is not a finite number",
                [](Checkpoint<2>& c) { c.state.velocity[0].x() = infinite; }},
        Forgery{"/state/rim_speed, entry 0, is not a finite number",
                [](Checkpoint<2>& c) { c.state.rim[0][0] = no_number; }},
        Forgery{"/state/image, entry 0, is not a number of periods from -1e9 to 1e9",
                [](Checkpoint<2>& c) { c.state.image[0][0] = std::numeric_limits<int>::min(); }},
        Forgery{"/state/pairs/i, entry 0, is not a grain",
                [](Checkpoint<2>& c) { c.state.pairs.i[0] = 4'000'000'000; }},
        Forgery{"/state/pairs/j, entry 0, is not a grain",
                [](Checkpoint<2>& c) { c.state.pairs.j[0] = 1; }},
        Forgery{"/state/pairs/impulse_n, entry 0, is not a finite number",
                [](Checkpoint<2>& c) { c.state.pairs.impulse_n[0] = no_number; }},
        Forgery{"/state/pairs/skin is not a positive length",
                [](Checkpoint<2>& c) { c.state.pairs.skin = 0; }},
        Forgery{"/state/pairs/skin is larger than a large grain",
                [](Checkpoint<2>& c) { c.state.pairs.skin = 1e300; }},
        Forgery{"/state/pairs/renewals is too large for a number of pair lists",
                [](Checkpoint<2>& c) { c.state.pairs.renewals = std::uint64_t{1} << 63; }},
        Forgery{"/trajectory/frames is too large for a number of frames",
                [](Checkpoint<2>& c) { c.trajectory.frames = std::uint64_t{1} << 63; }},
        Forgery{"/trajectory/begin is not a finite number",
                [](Checkpoint<2>& c) { c.trajectory.begin = no_number; }},
        Forgery{"/trajectory/wall is not a duration in s",
                [](Checkpoint<2>& c) { c.trajectory.wall = -1; }},
        Forgery{"/trajectory/totals has a negative number of steps",
                [](Checkpoint<2>& c) { c.trajectory.recorder.totals.steps = -1; }},
        Forgery{"/trajectory/since_frame/sweeps is not a finite number",
                [](Checkpoint<2>& c) { c.trajectory.recorder.since_frame.sweeps = no_number; }}));

TEST_F(CheckpointFile, ASceneThatIsNoneIsRefused)
{
  fs::remove(path);
  written.scene = "phi-large = 7\n";
  write_checkpoint(path, written);
  EXPECT_EQ(complaint().rfind(path + ": /scene is not a scene (", 0), 0u) << complaint();
}

TEST_F(CheckpointFile, GrainsInOnePlaceAreRefused)
{
  fs::remove(path);
  auto& grains = written.grains;
  for (int g = 0; g < 100; ++g) {
    grains.id.push_back(10'000 + g);
    grains.species.push_back(grains.species[0]);
    grains.radius.push_back(grains.radius[0]);
    grains.mass.push_back(grains.mass[0]);
    grains.fixed.push_back(0);
    written.state.row.push_back(static_cast<std::int32_t>(written.state.row.size()));
    written.state.position.emplace_back(1e-3, 1e-3);
    written.state.velocity.emplace_back(0, 0);
    written.state.image.push_back({0});
    written.state.rim.push_back({0});
    written.state.pairs.made_at.emplace_back(0, 0);
  }
  write_checkpoint(path, written);
  EXPECT_NE(complaint().find("/state/position has more than 64 grains in one place"),
            std::string::npos)
      << complaint();
}

TEST_F(CheckpointFile, ASizeThatTheFileCannotHoldIsRefusedBeforeMemoryIsTaken)
{
  tamper([](hid_t file) {
    H5Ldelete(file, "/state/rim_speed", H5P_DEFAULT);
    const hsize_t size = hsize_t{1} << 50, chunk = 1 << 20;
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    const hid_t create = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(create, 1, &chunk);
    H5Dclose(H5Dcreate2(file, "/state/rim_speed", H5T_IEEE_F64LE, space, H5P_DEFAULT, create,
                        H5P_DEFAULT));
    H5Pclose(create);
    H5Sclose(space);
  });
  EXPECT_EQ(complaint(), path +
                             ": /state/rim_speed claims to hold more than a file of this size "
                             "can; the file is damaged");
}

TEST_F(CheckpointFile, OneThatCannotBeWrittenLeavesTheOldOneWhole)
{
  fs::create_directory(path + ".part");  // occupies the name of the new file
  EXPECT_THROW(write_checkpoint(path, written), RunError);
  fs::remove(path + ".part");
  EXPECT_EQ(complaint(), "no complaint");
}

}  // namespace
}  // namespace grseg
