// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/earlier_run.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "sim/run/run_files.hpp"
#include "tests/folder.hpp"
#include "tests/sim/small_chute.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using Words = std::vector<std::string>;

/// Run of the small chute, and the files that an earlier run left under its names.
class EarlierRun : public TestInFolder {
 protected:
  RunOptions options;

  void SetUp() override
  {
    TestInFolder::SetUp();
    options.output = path("run.h5");
    options.checkpoint = path("run.chk");
    options.continues = true;
  }
  /// Writes run.h5.part with `frames` frames of the scene `words`, the first after step `begin` + 1.
  void leave_part(int frames, std::int64_t begin = 0, const Words& words = {})
  {
    const auto scene = small_chute::scene(words);
    auto simulation = small_chute::bed(scene);
    simulation.set_clock(begin);
    auto parameters = to_parameters(scene);
    const auto& world = simulation.world();
    TrajectoryWriter writer(part_of(options.output),
                            {world.grains, world.box, parameters, Recorder::observables(2)});
    Recorder recorder(writer, scene.small_diameter);
    Frame<2> frame;
    for (int k = 0; k < frames; ++k) {
      recorder.add(simulation.advance(frame));
      recorder.write(frame, simulation);
    }
    writer.close();
  }
  /// Leaves run.h5.part as a kill does before anything was committed.
  void leave_nothing_committed()
  {
    leave_part(0);
    const hid_t file = H5Fopen(part_of(options.output).c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t offset = H5Dopen2(file, "/grseg/contacts/offset", H5P_DEFAULT);
    const hsize_t none = 0;
    H5Dset_extent(offset, &none);
    H5Dclose(offset);
    H5Fclose(file);
  }
  /// Complaint about run.h5.part of a run of the scene `words`, with the folder's name left out.
  template <class Error = UsageError>
  std::string complaint(const Words& words = {}) const
  {
    auto text = complaint_of<Error>([&] { begins_again(small_chute::scene(words), options); });
    const auto whole = path("");
    for (auto at = text.find(whole); at != std::string::npos; at = text.find(whole))
      text.erase(at, whole.size());
    return text;
  }
};

TEST_F(EarlierRun, ThatWasKilledWithoutAFrameBeginsAgain)
{
  EXPECT_FALSE(begins_again(small_chute::scene(), options));
  put("run.h5.part", "");
  EXPECT_FALSE(begins_again(small_chute::scene(), options));
  leave_part(0);
  EXPECT_TRUE(begins_again(small_chute::scene(), options));
  leave_nothing_committed();
  EXPECT_TRUE(begins_again(small_chute::scene(), options));
  options.continues = false;
  EXPECT_TRUE(begins_again(small_chute::scene(), options));
}

TEST_F(EarlierRun, ThatWasKilledDuringItsDepositionBeginsAgain)
{
  leave_part(3, -10);
  EXPECT_TRUE(begins_again(small_chute::scene(), options));
  EXPECT_TRUE(begins_again(small_chute::scene({"--duration", "7"}), options));
}

TEST_F(EarlierRun, KeepsItsFramesOfTheFlow)
{
  leave_part(3);
  EXPECT_NE(complaint().find("run.h5.part has frames up to t = "), std::string::npos);
  EXPECT_NE(
      complaint().find("and their checkpoint is missing: name it with --checkpoint, or choose "
                       "another name for --output"),
      std::string::npos);
  options.continues = false;
  EXPECT_EQ(complaint(),
            "run.h5.part already exists; choose another name, remove it, or pass --overwrite");
  options.overwrite = true;
  EXPECT_EQ(complaint(), "no complaint");
}

TEST_F(EarlierRun, OfAnotherSceneKeepsItsFilesAndNamesTheKey)
{
  for (const auto& [key, own, other] : {std::tuple{"slope", "25", "24"},
                                        {"seed", "1", "2"},
                                        {"depth", "0.04m", "9dS"},
                                        {"large-grains", "not given", "3"},
                                        {"store", "float64", "float32"}})
    for (const int frames : {0, 3}) {
      leave_part(frames, -10);
      EXPECT_EQ(complaint({std::string("--") + key, other}),
                std::string("run.h5.part is of another scene, in which ") + key + " is " + own +
                    ": choose another name for --output, or give this value to begin that run "
                    "again");
    }
}

TEST_F(EarlierRun, ThatCannotBeReadKeepsItsFile)
{
  put("run.h5.part", "torn");
  EXPECT_EQ(complaint<FormatError>(),
            "run.h5.part: is not an HDF5 file, or is truncated or damaged; move it away to begin "
            "again");
  options.continues = false;
  EXPECT_EQ(complaint(),
            "run.h5.part already exists; choose another name, remove it, or pass --overwrite");
}

TEST_F(EarlierRun, IsContinuedFromThePreviousCheckpointIfTheLastOneIsMissing)
{
  EXPECT_EQ(checkpoint_of_earlier_run(options), "");
  put("run_prev.chk", "previous");
  EXPECT_EQ(checkpoint_of_earlier_run(options), path("run_prev.chk"));
  put("run.chk", "last");
  EXPECT_EQ(checkpoint_of_earlier_run(options), path("run.chk"));
}

TEST_F(EarlierRun, IsContinuedOnlyWithTheSameSteps)
{
  options.restart = "run.chk";
  const auto complaint = [&](const Words& words) {
    return complaint_of<UsageError>(
        [&] { require_same_run(small_chute::scene(), small_chute::scene(words), options); });
  };
  EXPECT_EQ(complaint({"--duration", "3", "--compression", "2"}), "no complaint");
  const std::string remedy =
      ": give this value to continue it, or choose other names for --output and --checkpoint to "
      "begin another run";
  EXPECT_EQ(complaint({"--seed", "3"}), "run.chk is of a run in which seed is 1" + remedy);
  EXPECT_EQ(complaint({"--slope", "3"}),
            "run.chk is of a run in which slope is 25" + remedy +
                "; --restart run.chk with another --output, instead of --continue, continues with "
                "the change");
}

TEST_F(EarlierRun, LeavesNoTemporaryFile)
{
  // No process has this number: it is above the largest that Linux gives.
  for (const char* name :
       {"run.h5.tmp.4194305", "run.h5.part.tmp.4194305", "run.h5.part.part",
        "run.h5.part.part.tmp.4194305", "run.chk.part", "run_prev.chk.tmp.4194305"})
    put(name, "left by a kill");
  // These stay: one has a writer that still runs, one belongs to another file, and two are no
  // temporary names.
  const std::set<std::string> others{"run.h5.tmp.1", "other.h5.tmp.4194305", "run.h5.tmp.mine",
                                     "run.h5.tmp.4194305.txt"};
  for (const auto& name : others) put(name, "another's");
  {
    const RunLocks locks(options);
  }
  EXPECT_EQ(names(), others);
}

}  // namespace
}  // namespace grseg
