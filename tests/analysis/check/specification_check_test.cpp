// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of spheres whose file violates formats/README.md in one place.
#include "analysis/check/file_check.hpp"
#include "tests/spheres.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace grseg {
namespace {

namespace fs = std::filesystem;

class Specification : public testing::Test {
 protected:
  std::string path =
      (fs::temp_directory_path() / fmt::format("grseg_specification_{}.h5", getpid())).string();
  void TearDown() override { fs::remove(path); }

  /// The one violation that is found, "PATH WHAT", or "".
  std::string departure(const RunDescription& run, const Frame<3>& frame) const
  {
    {
      TrajectoryWriter writer(path, run);
      writer.append(frame, std::vector<double>{8});
      writer.close();
    }
    const TrajectoryReader reader(path);
    SpecificationCheck check(reader);
    Frame<3> read;
    reader.read(0, read);
    check.add(0, read);
    const auto lines = check.lines();
    EXPECT_EQ(lines.size(), lines[0].verdict == Verdict::passed ? 1u : 2u);
    return lines.size() < 2 ? "" : fmt::format("{} {}", lines[1].quantity, lines[1].remark);
  }
};

TEST_F(Specification, OfARunOfSpheresHolds)
{
  EXPECT_EQ(departure(spheres::description(), spheres::frame(0)), "");
}

TEST_F(Specification, PutsPositionsInTheCellAlongItsPeriods)
{
  auto run = spheres::description();
  auto frame = spheres::frame(0);
  frame.position[1].z() = -0.001;
  EXPECT_EQ(departure(run, frame),
            "/particles/grains/position/value has z = -0.001 for grain 1 in frame 0, which is not "
            "in [0, 0.06)");
  frame.position[1] = {0.1, 0.014, 0.006};
  EXPECT_EQ(departure(run, frame),
            "/particles/grains/position/value has x = 0.1 for grain 1 in frame 0, which is not in "
            "[0, 0.1)");
  frame.position[1] = {0.05, 0.014, 0.07};
  run.box.periodic_z = false;
  EXPECT_EQ(departure(run, frame), "");
}

TEST_F(Specification, GivesGravityAComponentPerAxis)
{
  auto run = spheres::description();
  run.parameters.numbers["gravity"] = {3.8, -9.0};
  EXPECT_EQ(departure(run, spheres::frame(0)), "/parameters/gravity should be three numbers");
}

}  // namespace
}  // namespace grseg
