// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/recorder.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/reader.hpp"
#include "tests/sim/worlds.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace grseg {
namespace {

using worlds::world_of;

TEST(Recorder, TheMomentumDefectIsTheForceThatIsMissingOverTheLargest)
{
  World<2> world;
  worlds::add(world, {{0, 0}, 0.5});
  worlds::add(world, {{1, 0}, 0.5});
  Frame<2> frame;
  frame.contacts.i = {1};
  frame.contacts.j = {0};
  frame.contacts.force = {{4, 0}};
  frame.force = {{-4, 0}, {4, 0}};
  EXPECT_EQ(momentum_defect<2>(world.grains, frame, {0, 0}), 0);
  frame.force[0].y() = 1;
  EXPECT_EQ(momentum_defect<2>(world.grains, frame, {0, 0}), 0.25);
}

class RecorderFile : public testing::Test {
 protected:
  std::string path = (std::filesystem::temp_directory_path() /
                      ("grseg_recorder_test_" + std::to_string(getpid()) + ".h5"))
                         .string();
  void TearDown() override { std::filesystem::remove(path); }
  World<2> world = world_of({{{0, 0.5}, 0.5}});
  /// Records one step with this report; returns the value of `name` in the file.
  double record(const StepReport& report, const std::string& name)
  {
    Simulation<2> simulation(world, {{0, 0.5}});
    Frame<2> frame;
    simulation.advance(frame);
    {
      TrajectoryWriter writer(path, {world.grains, world.box, {}, Recorder::observables(2)});
      Recorder recorder(writer, 1);
      recorder.add(report);
      recorder.write(frame, simulation);
      writer.close();
    }
    return TrajectoryReader(path).observable(name)[0];
  }
};

TEST_F(RecorderFile, EveryNumberOfAStepIsFoundUnderItsName)
{
  StepReport report;
  report.solver = {.sweeps = 7, .residual = 0.5, .residual_rms = 0.25, .converged = false};
  report.touching = 4;
  report.force_bearing = 2;
  report.sum_overlap = 0.008;
  report.largest_overlap = 0.005;
  report.sum_gap_bearing = 0.002;
  report.fastest_approach = 3;
  for (const auto& [name, value] :
       std::vector<std::pair<std::string, double>>{{"steps", 1},
                                                   {"missed_steps", 1},
                                                   {"sweeps", 7},
                                                   {"residual", 0.5},
                                                   {"residual_rms", 0.25},
                                                   {"touching", 4},
                                                   {"contacts", 2},
                                                   {"mean_overlap", 0.002},
                                                   {"largest_overlap", 0.005},
                                                   {"mean_gap", 0.001},
                                                   {"fastest_approach", 3}})
    EXPECT_DOUBLE_EQ(record(report, name), value) << name;
}

TEST_F(RecorderFile, WhatMovingBoundariesDoIsRecorded)
{
  world = world_of({{{0, 0.5}, 0.5}, {{0, -0.5}, 0.5, true}});
  Simulation<2> simulation(world, {{0, 0.5}, {0, -0.4995}});
  BoundaryBody base;
  base.begin = 1;
  base.end = 2;
  base.velocity = {0, 2};
  simulation.drive({base});
  Frame<2> frame;
  {
    TrajectoryWriter writer(path, {world.grains, world.box, {}, Recorder::observables(2)});
    Recorder recorder(writer, 1);
    recorder.add(simulation.advance(frame));
    recorder.write(frame, simulation);
    writer.close();
  }
  // Hit without rebound, the disc moves on with the base: force m v/h along v h.
  const TrajectoryReader file(path);
  const double mass = world.grains.mass[0];
  EXPECT_NEAR(file.observable("work_of_boundaries")[0], mass * 4, 1e-12);
  EXPECT_NEAR(file.observable("work_of_contacts")[0], -mass * 2, 1e-12);
  EXPECT_NEAR(file.observable("translational_energy")[0], mass * 2, 1e-12);
}

TEST_F(RecorderFile, FastGrainsMayOverlapByWhatTheyApproachInAStep)
{
  StepReport report;
  report.touching = 1;
  report.sum_overlap = 0.05;
  report.farthest_approach = 0.051;
  EXPECT_NO_THROW(record(report, "steps"));
  report.farthest_approach = 0.049;
  EXPECT_THROW(record(report, "steps"), RunError);
}

TEST(StepTotals, OneDeepOverlapIsSeenUnlessItsApproachMadeIt)
{
  StepTotals totals;
  totals.largest_overlap = 0.26;
  EXPECT_TRUE(totals.passed_into(1));
  EXPECT_FALSE(totals.passed_into(2));
  totals.farthest_approach = 0.3;
  EXPECT_FALSE(totals.passed_into(1));
}

TEST_F(RecorderFile, ARunThatOverlapsOrTunnelsIsStopped)
{
  StepReport report;
  report.touching = 1;
  report.sum_overlap = 0.0099;
  EXPECT_NO_THROW(record(report, "steps"));
  report.sum_overlap = 0.0101;
  EXPECT_THROW(record(report, "steps"), RunError);
  report.sum_overlap = 0;
  report.farthest_approach = 0.49;
  EXPECT_NO_THROW(record(report, "steps"));
  report.farthest_approach = 0.51;
  EXPECT_THROW(record(report, "steps"), RunError);
}
}  // namespace
}  // namespace grseg
