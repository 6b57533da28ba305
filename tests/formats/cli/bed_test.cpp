// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/bed.hpp"

#include "tests/folder.hpp"
#include "tests/three_grains.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

class BedLine : public TestInFolder {
 protected:
  /// Bed of the run of three grains, with these texts and a seed.
  Bed of(const std::string& scene, const std::string& history, double seed = 1) const
  {
    auto run = three_grains::description();
    run.parameters.texts["scene"] = scene;
    run.parameters.texts["history"] = history;
    run.parameters.numbers["seed"] = {seed};
    TrajectoryWriter writer(path("run.h5"), run, {});
    writer.append(three_grains::frame(0), std::vector<double>{0});
    writer.close();
    return bed_of(TrajectoryReader(path("run.h5")));
  }
};

const std::string scene = "slope = 23\nduration = 2\nseed = 1\nstore = float64\n";
const std::string sim = "grseg-sim chute.ini -o run.h5";

// Digest computed in Python: zlib.crc32(struct.pack("<3i", 7, 8, 9), zlib.crc32(struct.pack("<3d",
// 0.005, 0.0025, 0.005))).
TEST_F(BedLine, NamesTheGrainsByTheirRadiiAndIds)
{
  three_grains::write(path("hand.h5"), 1);
  const auto bed = bed_of(TrajectoryReader(path("hand.h5")));
  EXPECT_EQ(bed.text(), "grains 3, sizes 2, crc32 e6b1d670");
  EXPECT_TRUE(bed.varied);
  EXPECT_FALSE(bed.come_and_go);
}

TEST_F(BedLine, IsReadAsItWasWritten)
{
  for (const auto& bed :
       {Bed{"grains 3, sizes 2, crc32 e6b1d670", true, false, "", ""},
        Bed{"grains 9, sizes 2, crc32 e6b1d670", false, true, "4294967295", "00000001"}}) {
    const auto read = parse_bed(bed.text());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->text(), bed.text());
    EXPECT_EQ(read->varied, bed.varied);
    EXPECT_EQ(read->come_and_go, bed.come_and_go);
    EXPECT_EQ(read->seed, bed.seed);
    EXPECT_EQ(read->flow, bed.flow);
  }
  for (const char* wrong : {"", "grains", "grains 3, crc32 e6b1d670", "3, 2, 1"})
    EXPECT_FALSE(parse_bed(wrong)) << wrong;
}

TEST_F(BedLine, TheFlowIsThatOfALongerRunAndOfOneThatIsStoredOtherwise)
{
  const auto flow = of(scene, sim).flow;
  EXPECT_EQ(of("slope = 23\nduration = 9\nseed = 1\nstore = float32\n", "grseg-sim other.ini").flow,
            flow);
  const auto longer =
      "\ngrseg-sim --restart run.chk --duration 3 --checkpoint a.chk -o more.h5 (from t = 2 s)";
  EXPECT_EQ(of(scene, sim + longer).flow, flow);
}

TEST_F(BedLine, TheFlowIsAnotherOneWhereTheMotionIs)
{
  const auto flow = of(scene, sim).flow;
  EXPECT_NE(of("slope = 24\nduration = 2\nseed = 1\nstore = float64\n", sim).flow, flow);
  const auto twin = [&](const std::string& seed, const std::string& time) {
    return of(scene, sim + "\ngrseg-sim --restart run.chk --perturb 1e-6 --seed-perturbation " +
                         seed + " -o twin.h5 (from t = " + time + " s)")
        .flow;
  };
  EXPECT_NE(twin("2", "2"), flow);
  EXPECT_NE(twin("3", "2"), twin("2", "2"));
  EXPECT_NE(twin("2", "4"), twin("2", "2"));
}

TEST_F(BedLine, ARunWithoutASceneStatesNoFlow)
{
  EXPECT_EQ(of("", "grseg-import --format lammps").flow, "");
}

}  // namespace
}  // namespace grseg
