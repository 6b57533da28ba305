// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/reader.hpp"
#include "sim/run/run_files.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace grseg {
namespace {

namespace fs = std::filesystem;

/// A run of six frames whose partial file remained, and a checkpoint written when it had three frames.
class CutBack : public testing::Test {
 protected:
  std::string part =
      (fs::temp_directory_path() / ("grseg_cut_back_test_" + std::to_string(getpid()) + ".h5.part"))
          .string();
  Scene scene = small_chute::scene();
  Simulation<2> simulation = small_chute::bed(scene);
  Checkpoint<2> checkpoint;

  void record(TrajectoryWriter& writer, Recorder& recorder, int frames)
  {
    Frame<2> frame;
    for (int k = 0; k < frames; ++k) {
      recorder.add(simulation.advance(frame));
      recorder.write(frame, simulation);
    }
    writer.flush();
  }
  void SetUp() override
  {
    auto parameters = to_parameters(scene);
    parameters.numbers["summary_mean_gap"] = {1};
    const auto& world = simulation.world();
    TrajectoryWriter writer(part, {world.grains, world.box, parameters, Recorder::observables(2)});
    Recorder recorder(writer, scene.small_diameter);
    record(writer, recorder, 3);
    checkpoint = small_chute::checkpoint_of(simulation, scene);
    checkpoint.trajectory = {writer.frames(), writer.digest(), recorder.state(), 0, 0};
    record(writer, recorder, 3);
    writer.close();
  }
  void TearDown() override
  {
    EXPECT_FALSE(fs::exists(part + ".part"));
    fs::remove(part);
  }

  TrajectoryWriter cut() const
  {
    return truncate_to_checkpoint({part, part, checkpoint.scene, "history"}, checkpoint, "run.chk",
                                  {});
  }
  std::string bytes() const
  {
    std::ifstream file(part, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  template <class Error = UsageError>
  void expect_refusal() const
  {
    const auto before = bytes();
    EXPECT_THROW(cut(), Error);
    EXPECT_EQ(bytes(), before);
  }
};

TEST_F(CutBack, TheFramesOfTheCheckpointStayAndTheRunGoesOnAsItWent)
{
  const auto whole = TrajectoryReader(part).digest();
  const auto sweeps = TrajectoryReader(part).observable("sweeps");
  simulation = Simulation<2>(simulation.world(), checkpoint.state);
  {
    auto writer = cut();
    EXPECT_EQ(writer.frames(), 3u);
    EXPECT_EQ(writer.digest(), checkpoint.trajectory.digest);
    Recorder recorder(writer, scene.small_diameter, checkpoint.trajectory.recorder);
    record(writer, recorder, 3);
  }
  const TrajectoryReader run(part);
  EXPECT_EQ(run.digest(), whole);
  EXPECT_EQ(run.observable("sweeps"), sweeps);
}

TEST_F(CutBack, TheFileNoLongerSaysThatItIsComplete)
{
  cut();
  const auto parameters = TrajectoryReader(part).parameters();
  EXPECT_FALSE(parameters.numbers.contains("complete"));
  EXPECT_FALSE(parameters.numbers.contains("summary_mean_gap"));
  EXPECT_EQ(parameters.text("history"), "history");
  EXPECT_EQ(parameters.text("scene"), checkpoint.scene);
}

TEST_F(CutBack, OneOtherNumberInAnyFrameIsDamage)
{
  const hid_t file = H5Fopen(part.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t time = H5Dopen2(file, "/particles/grains/position/time", H5P_DEFAULT);
  std::vector<double> times(6);
  H5Dread(time, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, times.data());
  times[1] *= 1 + 1e-15;
  H5Dwrite(time, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, times.data());
  H5Dclose(time);
  H5Fclose(file);
  expect_refusal<FormatError>();
}

TEST_F(CutBack, APartWithFewerFramesThanTheCheckpointIsRefused)
{
  checkpoint.trajectory.frames = 7;
  expect_refusal();
}

TEST_F(CutBack, APartOfAProlongationThatWasKilledBeforeItsFirstCheckpointIsContinued)
{
  const auto longer = checkpoint.scene;
  checkpoint.scene = to_text(small_chute::scene({"--duration", "3"}));
  EXPECT_EQ(truncate_to_checkpoint({part, part, longer, ""}, checkpoint, "run.chk", {}).frames(),
            3u);
}

TEST_F(CutBack, APartOfAnotherSceneOrOfOtherGrainsIsRefused)
{
  const auto own = checkpoint;
  checkpoint.trajectory = {};  // before its first frame: scene and grains
  checkpoint.scene = to_text(small_chute::scene({"--slope", "21"}));
  expect_refusal();
  checkpoint.scene = own.scene;
  checkpoint.grains.radius[0] *= 2;
  expect_refusal();
}

}  // namespace
}  // namespace grseg
