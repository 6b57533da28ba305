// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/digest.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/reader.hpp"
#include "tests/three_grains.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <functional>
namespace grseg {
namespace {
TEST(Digest, ChangesWithTheLastBitOfEveryFieldAndWithEarlierFrames)
{
  const auto whole = three_grains::frame(1);
  const auto digest = frame_digest(whole, 1, false);
  EXPECT_NE(frame_digest(whole, 2, false), digest);
  const auto nudge = [](double& x) { x = std::nextafter(x, 1e9); };
  const std::vector<std::function<void(Frame<2>&)>> changes{
      [](Frame<2>& f) { ++f.step; },
      [&](Frame<2>& f) { nudge(f.time); },
      [&](Frame<2>& f) { nudge(f.position.back().y()); },
      [](Frame<2>& f) { ++f.image.back()[1]; },
      [&](Frame<2>& f) { nudge(f.velocity.back().y()); },
      [&](Frame<2>& f) { nudge(f.angular_velocity.back()); },
      [&](Frame<2>& f) { nudge(f.force.back().y()); },
      [](Frame<2>& f) { ++f.contacts.i.back(); },
      [](Frame<2>& f) { ++f.contacts.j.back(); },
      [&](Frame<2>& f) { nudge(f.contacts.force.back().y()); },
      [&](Frame<2>& f) { nudge(f.contacts.branch.back().y()); },
      [&](Frame<2>& f) { nudge(f.contacts.gap.back()); }};
  for (std::size_t k = 0; k < changes.size(); ++k) {
    auto other = whole;
    changes[k](other);
    EXPECT_NE(frame_digest(other, 1, false), digest) << "change " << k;
  }
}

TEST(Digest, OfASinglePrecisionFileIsThatOfItsStoredNumbers)
{
  const auto frame = three_grains::frame(1);
  auto rounded = frame;
  for (auto& f : rounded.contacts.force) f = f.cast<float>().cast<double>();
  EXPECT_EQ(frame_digest(rounded, 0, true), frame_digest(frame, 0, true));
  EXPECT_NE(frame_digest(rounded, 0, false), frame_digest(frame, 0, false));
}

class TrajectoryMore : public testing::Test {
 protected:
  std::string path =
      (std::filesystem::temp_directory_path() / ("grseg_more_" + std::to_string(getpid()) + ".h5"))
          .string();
  void TearDown() override { std::filesystem::remove(path); }
  void write(const RunDescription& run, const std::vector<Frame<2>>& frames)
  {
    TrajectoryWriter writer(path, run);
    for (const auto& frame : frames) writer.append(frame, std::vector<double>{0});
    writer.add_parameters({{{"summary_height", {2.5}}}, {}});
    writer.close();
  }
  std::string complaint(const std::vector<Frame<2>>& frames)
  {
    write(three_grains::description(), frames);
    try {
      const TrajectoryReader reader(path);
      Frame<2> frame;
      for (std::size_t k = 0; k < reader.size(); ++k) reader.read(k, frame);
    } catch (const FormatError& error) {
      return error.what();
    }
    return "no complaint";
  }
};

TEST_F(TrajectoryMore, ABoxBetweenWallsAndALateParameterAreReadBack)
{
  auto run = three_grains::description();
  run.box.periodic_x = false;
  write(run, {three_grains::frame(0)});
  const TrajectoryReader reader(path);
  EXPECT_FALSE(reader.box().periodic_x);
  EXPECT_EQ(reader.parameters().number("summary_height", path), 2.5);
}

TEST_F(TrajectoryMore, ImpossibleContentIsRefusedByName)
{
  const auto good = three_grains::frame(0);
  auto bad = good;
  bad.contacts.gap[1] = std::nan("");
  EXPECT_NE(complaint({bad}).find("/grseg/contacts/gap is not a finite number"), std::string::npos);
  bad = good;
  bad.position[1].y() = INFINITY;
  EXPECT_NE(complaint({bad}).find("position/value is not a finite"), std::string::npos);
  bad = good;
  bad.contacts.i[0] = -1;
  EXPECT_NE(complaint({bad}).find("joins grains -1 and 1"), std::string::npos);
  EXPECT_NE(complaint({good, good}).find("do not increase at frame 1"), std::string::npos);
  EXPECT_EQ(complaint({good, three_grains::frame(1)}), "no complaint");
}
}  // namespace
}  // namespace grseg
