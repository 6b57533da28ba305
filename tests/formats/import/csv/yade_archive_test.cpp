// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive.hpp"
#include "tests/formats/import/archive_balance.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

/// Tables that scripts/archives/yade_export.py wrote, compared with values that YADE computes itself.
namespace grseg {
namespace {

using namespace archive_balance;

const std::string inputs = GRSEG_TEST_INPUTS "/yade/";

std::unique_ptr<Archive> open(const std::string& name)
{
  ArchiveFiles files;
  files.grains = {inputs + name + "-grains.csv.gz"};
  files.contacts = {inputs + name + "-contacts.csv.gz"};
  return csv_format.open(files);
}

/// Rows of `columns` numbers that follow a time, by time.
std::map<double, std::vector<double>> rows_of(const std::string& name, std::size_t columns)
{
  std::ifstream file(inputs + name);
  std::map<double, std::vector<double>> rows;
  for (double time = 0; file >> time;) {
    auto& row = rows[time];
    row.resize(columns);
    for (auto& number : row) file >> number;
  }
  return rows;
}

TEST(YadeArchive, StressOfAPeriodicChuteIsYadesOwn)
{
  const auto own = rows_of("chute-stress.csv", 9);
  const auto archive = open("chute");
  std::size_t frames = 0;
  for (const auto& frame : all_of(*archive)) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t c = 0; c < frame.contacts.size(); ++c)
      sum += frame.contacts.force[c] * frame.contacts.branch[c].transpose();
    const auto& row = own.at(*frame.time);
    Eigen::Matrix3d yades;
    yades << row[0], row[1], row[2], row[3], row[4], row[5], row[6], row[7], row[8];
    // YADE's stress is for its cell of 8 x 6 x 40, tension positive.
    EXPECT_LT((sum / (8 * 6 * 40) + yades).norm(), 1e-13 * yades.norm());
    EXPECT_LT(residual(frame, *archive->facts().gravity), 1e-13);
    EXPECT_EQ(frame.periodic, (std::array<bool, 3>{true, true, false}));
    ++frames;
  }
  EXPECT_EQ(frames, 6u);
}

TEST(YadeArchive, BoundsOfABoxAreWallsWithTheForcesThatYadeSums)
{
  const auto own = rows_of("box-walls.csv", 21);
  const auto archive = open("box");
  const auto frames = all_of(*archive);
  const double g = archive->facts().gravity->norm();
  std::set<std::size_t> counts;
  for (const auto& frame : frames) {
    const auto& contacts = frame.contacts;
    std::vector<Vec3> felt(7, Vec3::Zero());  // forces on the floor, two boxes and four facets
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (at_wall(contacts, c))
        felt.at(static_cast<std::size_t>(contacts.wall[c])) -= contacts.force[c];
    const auto& row = own.at(*frame.time);
    for (std::size_t w = 0; w < 7; ++w)
      EXPECT_LT((felt[w] - Vec3(row[3 * w], row[3 * w + 1], row[3 * w + 2])).norm(), 1e-13);
    EXPECT_LT(residual(frame, *archive->facts().gravity), 1e-13);
    counts.insert(frame.grains.size());
  }
  EXPECT_GT(counts.size(), 3u) << "it is being filled";

  double weight = 0, carried = 0;  // at the end it rests, except for small oscillations
  for (const double mass : frames.back().grains.mass) weight += mass * g;
  for (std::size_t c = 0; c < frames.back().contacts.size(); ++c)
    if (at_wall(frames.back().contacts, c)) carried += frames.back().contacts.force[c].z();
  EXPECT_NEAR(carried / weight, 1, 0.01);
}

TEST(YadeArchive, BranchesAtWallsEndOnThem)
{
  for (const auto& frame : all_of(*open("box"))) {
    const auto entry = entries(frame.grains);
    for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
      if (!at_wall(frame.contacts, c)) continue;
      const auto& contacts = frame.contacts;
      const auto i = entry.at(contacts.i[c]);
      const Vec3 point = frame.grains.position[i] - contacts.branch[c];
      const double away[] = {point.z(), point.x(),        point.x() - 0.06, point.y(),
                             point.y(), point.y() - 0.06, point.y() - 0.06};
      EXPECT_NEAR(away[contacts.wall[c]], 0, 1e-15);
      EXPECT_NEAR(contacts.branch[c].norm(), frame.grains.radius[i] - contacts.overlap[c], 1e-15);
    }
  }
}

}  // namespace
}  // namespace grseg
