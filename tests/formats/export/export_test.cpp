// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/frame_range.hpp"
#include "formats/core/errors.hpp"
#include "formats/export/run_writers.hpp"
#include "formats/export/vtk.hpp"
#include "tests/formats/export/exported.hpp"
#include "tests/three_grains.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <sstream>

namespace grseg {
namespace {

/// Three grains. The large one (row 0, id 7) also touches straight wall 1 on its left, and the
/// small one (row 1) touches a periodic image of the large one: the large grain is at x = 0.001,
/// the small one at 0.345.
class Export : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("grseg_export_test_" + std::to_string(getpid()));
  std::string run_path = (folder / "run.h5").string();

  void SetUp() override
  {
    fs::create_directories(folder);
    auto frame = three_grains::frame(0);
    frame.position[0].x() = 0.001;
    frame.position[1] = {0.345, 0.01};
    frame.contacts.i = {0, 1};
    frame.contacts.j = {-2, 0};
    frame.contacts.force = {{2, 1}, {-3, 4}};
    frame.contacts.branch = {{0.005, 0}, {-0.006, 0.0045}};  // normals (1, 0) and (-0.8, 0.6)
    frame.contacts.gap = {0, 0.000125};
    TrajectoryWriter writer(run_path, three_grains::description());
    writer.append(frame, std::vector<double>{0.25});
    writer.append(three_grains::frame(1), std::vector<double>{0.5});
    writer.append(three_grains::frame(2), std::vector<double>{0.75});
    writer.close();
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string at(const char* name) const { return (folder / name).string(); }
  std::size_t files() const
  {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
  void write(RunWriter& writer, const TrajectoryReader& run, std::size_t count)
  {
    Frame<2> frame;
    for (std::size_t k = 0; k < count; ++k) {
      run.read(k, frame, {.velocity = true, .contacts = true, .force = true});
      writer.add(frame);
    }
    writer.publish();
  }
};

TEST_F(Export, AContactAcrossThePeriodicEdgeLeavesTheCellRatherThanCrossThePicture)
{
  const TrajectoryReader run(run_path);
  write(*vtp_writer(run, view_cell(run, 0), at("view"), false), run, 1);
  const auto vtp = content(folder / "view/contacts/000000.vtp");
  const auto points = array_in<float>(vtp, "Points");
  ASSERT_EQ(points.size(), 12U);  // two lines of two points
  EXPECT_FLOAT_EQ(points[6], 0.345F);
  EXPECT_FLOAT_EQ(points[9], 0.351F);  // the image of x = 0.001
  EXPECT_FLOAT_EQ(points[10], 0.0055F);
}

/// Writes the three grains in two frames; the small one (row 1, id 8) is absent in the second frame.
void write_with_an_absent_grain(const std::string& path)
{
  auto run = three_grains::description();
  run.grains_come_and_go = true;
  auto frame = three_grains::frame(1);
  frame.contacts.clear();
  make_absent(frame, 1);
  TrajectoryWriter writer(path, run);
  writer.append(three_grains::frame(0), std::vector<double>{0});
  writer.append(frame, std::vector<double>{0});
  writer.close();
}

TEST_F(Export, AGrainThatIsAbsentIsLeftOutWhereTheFormatAllowsIt)
{
  write_with_an_absent_grain(at("changing.h5"));
  const TrajectoryReader run(at("changing.h5"));
  const auto cell = view_cell(run, 1);
  EXPECT_TRUE(std::isfinite(cell.low[1]) && std::isfinite(cell.high[1]));

  write(*vtp_writer(run, view_cell(run, 0), at("view"), false), run, 2);
  const auto vtp = content(folder / "view/grains/000001.vtp");
  EXPECT_EQ(array_in<std::int32_t>(vtp, "id"), (std::vector<std::int32_t>{7, 9}));
  EXPECT_EQ(array_in<float>(vtp, "radius"), (std::vector<float>{0.005F, 0.005F}));
  EXPECT_EQ(array_in<float>(vtp, "velocity"), (std::vector<float>{0.1F, 0.2F, 0, 0, 0, 0}));
  EXPECT_EQ(array_in<std::int32_t>(content(folder / "view/grains/000000.vtp"), "id").size(), 3U);

  write(*extxyz_writer(run, cell, at("run.xyz"), false), run, 2);
  const auto xyz = lines_of(content(folder / "run.xyz"));
  ASSERT_EQ(xyz.size(), 5U + 4U);
  EXPECT_EQ(xyz[5], "2");
  EXPECT_EQ(xyz[7].substr(0, 2), "7 ");
  EXPECT_EQ(xyz[8].substr(0, 2), "9 ");

  const auto dump = lammps_writer(run, cell, at("run.dump"), false);
  write(*dump, run, 2);
  const auto text = content(folder / "run.dump");
  EXPECT_NE(text.find("NUMBER OF ATOMS\n2\n"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST_F(Export, AContactWithAWallEndsWhereTheGrainTouches)
{
  const TrajectoryReader run(run_path);
  write(*vtp_writer(run, view_cell(run, 0), at("view"), false), run, 1);
  const auto vtp = content(folder / "view/contacts/000000.vtp");
  const auto points = array_in<float>(vtp, "Points");
  EXPECT_FLOAT_EQ(points[0], 0.001F);
  EXPECT_FLOAT_EQ(points[3], -0.004F);
  EXPECT_EQ(array_in<std::int32_t>(vtp, "j"), (std::vector<std::int32_t>{-2, 7}));
  EXPECT_EQ(array_in<std::int32_t>(vtp, "pair_type"), (std::vector<std::int32_t>{4, 1}));  // Lb, LS
}

// With the normals (1, 0) and (-0.8, 0.6): the force (2, 1) is 2 along and 1 across, (-3, 4) is 4.8
// and -1.4.
TEST_F(Export, TheNormalForcePushesApartAndTheTangentialOneIsAcross)
{
  const TrajectoryReader run(run_path);
  write(*vtp_writer(run, view_cell(run, 0), at("view"), false), run, 1);
  const auto vtp = content(folder / "view/contacts/000000.vtp");
  const auto at_points = array_in<float>(vtp, "normal_force");
  ASSERT_EQ(at_points.size(), 4U);
  EXPECT_FLOAT_EQ(at_points[0], 2);
  EXPECT_FLOAT_EQ(at_points[3], 4.8F);
  const auto tangential = array_in<float>(vtp, "tangential_force");
  EXPECT_FLOAT_EQ(tangential[0], 1);
  EXPECT_FLOAT_EQ(tangential[1], -1.4F);
}

TEST_F(Export, TheListOfTimesNamesEveryFile)
{
  const TrajectoryReader run(run_path);
  write(*vtp_writer(run, view_cell(run, 0), at("view"), false), run, 2);
  const auto list = content(folder / "view/grains.pvd");
  EXPECT_NE(list.find("timestep=\"5e-05\" part=\"0\" file=\"grains/000000.vtp\""), list.npos);
  const auto second = list.find("timestep=\"", list.find("grains/000000.vtp")) + 10;
  EXPECT_EQ(std::stod(list.substr(second)), run.times()[1]);
  EXPECT_EQ(list.find("grains/000001.vtp", second), list.find("grains/", second));
  EXPECT_TRUE(fs::exists(folder / "view/grains/000001.vtp"));
  EXPECT_FALSE(fs::exists(folder / "view/grains/000002.vtp"));
}

TEST_F(Export, NormalAndTangentialForceOfALammpsRowAddUp)
{
  const TrajectoryReader run(run_path);
  write(*lammps_writer(run, view_cell(run, 0), at("run.dump"), false), run, 1);
  const auto lines = lines_of(content(folder / "run.contacts.dump"));
  ASSERT_EQ(lines.size(), 15U);
  EXPECT_EQ(lines[2], "ITEM: TIME");
  EXPECT_EQ(lines[3], "5e-05");
  EXPECT_EQ(lines[7], "2");
  EXPECT_EQ(lines[8], "ITEM: BOX BOUNDS pp ff pp");
  std::istringstream header(lines[12]), row(lines[13]);
  std::string word;
  std::map<std::string, double> value;
  header >> word >> word;  // ITEM: ENTRIES
  while (header >> word) row >> value[word];
  // In the row of a wall, the grain's id appears twice.
  EXPECT_EQ(value["batom1"], 7);
  EXPECT_EQ(value["batom2"], 7);
  EXPECT_EQ(value["wall"], 1);
  EXPECT_EQ(value["dist"], 0.005);
  EXPECT_EQ(value["fx"], 2);
  EXPECT_EQ(value["fy"], 0);
  EXPECT_EQ(value["p1"], 0);
  EXPECT_EQ(value["p2"], 1);
  EXPECT_EQ(value["forcex"], 2);
  EXPECT_EQ(value["forcey"], 1);
  EXPECT_EQ(value["branchx"], 0.005);
  EXPECT_EQ(value["overlap"], 0);
}

TEST_F(Export, TheFileOfContactsKeepsTheEndingOfTheDump)
{
  const TrajectoryReader run(run_path);
  write(*lammps_writer(run, view_cell(run, 0), at("a.dump.gz"), false), run, 1);
  EXPECT_TRUE(fs::exists(folder / "a.contacts.dump.gz"));
  write(*lammps_writer(run, view_cell(run, 0), at("b"), false), run, 1);
  EXPECT_TRUE(fs::exists(folder / "b.contacts"));
  EXPECT_EQ(content(folder / "a.dump.gz").substr(0, 2), "\x1f\x8b");
}

// The lowest grain ends at y = -0.01, the box is 0.5 high, and along z it has space for a sphere.
TEST_F(Export, TheCellHoldsEveryGrainAndKeepsItsPeriod)
{
  const TrajectoryReader run(run_path);
  const auto cell = view_cell(run, 0);
  EXPECT_EQ(cell.low, (std::array<double, 3>{0, -0.01, -0.005}));
  EXPECT_EQ(cell.high, (std::array<double, 3>{0.35, 0.5, 0.005}));
  write(*extxyz_writer(run, cell, at("run.xyz"), false), run, 1);
  const auto lines = lines_of(content(folder / "run.xyz"));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0], "3");
  EXPECT_EQ(
      lines[1].find(R"(Lattice="0.35 0 0 0 0.51 0 0 0 0.01" Origin="0 -0.01 -0.005" pbc="T F F")"),
      0U);
  EXPECT_EQ(lines[2].find("7 2 0.001 0.005 0 0.1 0.2 0 0.005 "), 0U);
}

TEST_F(Export, AnUnfinishedExportLeavesNothingBehind)
{
  const TrajectoryReader run(run_path);
  const auto cell = view_cell(run, 0);
  Frame<2> frame;
  run.read(0, frame, {.velocity = true, .contacts = true, .force = true});
  {
    const auto vtp = vtp_writer(run, view_cell(run, 0), at("view"), false);
    const auto xyz = extxyz_writer(run, cell, at("run.xyz.gz"), false);
    const auto lammps = lammps_writer(run, cell, at("run.dump"), false);
    const auto h5md = h5md3d_writer(run, cell, at("view.h5md"), false);
    vtp->add(frame);
    xyz->add(frame);
    lammps->add(frame);
    h5md->add(frame);
    EXPECT_EQ(files(), 1U + 5U);
  }
  EXPECT_EQ(files(), 1U);  // only the run
}

TEST_F(Export, OverwritingReplacesAnExportAndNoOtherFolder)
{
  const TrajectoryReader run(run_path);
  write(*vtp_writer(run, view_cell(run, 0), at("view"), false), run, 3);
  EXPECT_THROW(vtp_writer(run, view_cell(run, 0), at("view"), false), UsageError);
  write(*vtp_writer(run, view_cell(run, 0), at("view"), true), run, 1);
  EXPECT_TRUE(fs::exists(folder / "view/grains/000000.vtp"));
  EXPECT_FALSE(fs::exists(folder / "view/grains/000002.vtp"));
  EXPECT_FALSE(fs::exists(folder / "view.old"));
  fs::create_directory(folder / "letters");
  EXPECT_THROW(vtp_writer(run, view_cell(run, 0), at("letters"), true), UsageError);
}

TEST_F(Export, FramesAreChosenByWholeSteps)
{
  const TrajectoryReader run(run_path);  // steps 0, 500, 1000 of 1e-4 s
  using Frames = std::vector<std::size_t>;
  EXPECT_EQ(FrameRange{}.frames_of(run), (Frames{0, 1, 2}));
  EXPECT_EQ((FrameRange{.begin = 0.05, .end = 0.1}).frames_of(run), (Frames{1}));
  EXPECT_EQ((FrameRange{.begin = 0.0501}).frames_of(run), (Frames{2}));
  EXPECT_EQ((FrameRange{.stride = 2}).frames_of(run), (Frames{0, 2}));
  EXPECT_THROW((FrameRange{.begin = 7}).frames_of(run), RunError);
  EXPECT_THROW((FrameRange{.stride = 0}).frames_of(run), UsageError);
}

}  // namespace
}  // namespace grseg
