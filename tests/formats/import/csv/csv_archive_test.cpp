// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/csv/csv_archive.hpp"

#include "tests/formats/import/archive_balance.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace grseg {
namespace {

namespace fs = std::filesystem;
using namespace archive_balance;

const std::string grain_rows =
    "0.5,7,0.1,0.2,0.05,1,2,-3\n"
    "0.5,9,0.1,0.105,0.05,0,0,0\n"
    "0.6,9,0.1,0.105,0.05,0,0,0\n"
    "0.6,7,0.1,0.21,0.05,1,2,-3\n";
const std::string grain_table = "time,id,x,y,radius,vx,vy,omega\n" + grain_rows;
const std::string contact_table =
    "time,i,j,fx,fy,overlap\n"
    "0.5,7,9,0.25,-4,0.005\n"
    "0.6,7,9,0,0,0\n";

class Csv : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("grseg_csv_" + std::to_string(getpid()));
  void SetUp() override { fs::create_directory(folder); }
  void TearDown() override { fs::remove_all(folder); }

  ArchiveFiles files(const std::string& grains, const std::string& contacts) const
  {
    std::ofstream(folder / "grains.csv") << grains;
    std::ofstream(folder / "contacts.csv") << contacts;
    ArchiveFiles all;
    all.grains = {(folder / "grains.csv").string()};
    all.contacts = {(folder / "contacts.csv").string()};
    return all;
  }
  std::vector<ArchiveMoment> read(const std::string& grains, const std::string& contacts) const
  {
    return all_of(*open_csv(files(grains, contacts)));
  }
  std::string complaint(const std::string& grains, const std::string& contacts) const
  {
    try {
      read(grains, contacts);
    } catch (const ToolError& error) {
      return error.what();
    }
    return "no complaint";
  }
  void expect_the_same(const std::string& grains, const std::string& contacts) const;
};

std::string with(std::string text, const std::string& from, const std::string& to)
{
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

void Csv::expect_the_same(const std::string& grains, const std::string& contacts) const
{
  const auto moments = read(grains, contacts);
  ASSERT_EQ(moments.size(), 2u) << grains;
  const auto& first = moments[0];
  EXPECT_EQ(*first.time, 0.5);
  EXPECT_EQ(first.grains.id, (std::vector<std::int64_t>{7, 9}));
  EXPECT_EQ(first.grains.position[0], Vec3(0.1, 0.2, 0));
  EXPECT_EQ(first.grains.radius, (std::vector<double>{0.05, 0.05}));
  EXPECT_EQ(first.grains.velocity[0], Vec3(1, 2, 0));
  EXPECT_EQ(first.grains.angular_velocity[0], Vec3(0, 0, -3));
  EXPECT_EQ(first.contacts.force[0], Vec3(0.25, -4, 0));
  EXPECT_EQ(first.contacts.i[0], 7);
  EXPECT_EQ(first.contacts.j[0], 9);
  EXPECT_EQ(moments[1].grains.id, (std::vector<std::int64_t>{9, 7}));
}

TEST_F(Csv, CommasSemicolonsTabsAndBlanksSeparateColumns)
{
  for (const char* separator : {",", ";", "\t", " ", "  ", ", "})
    expect_the_same(with(grain_table, ",", separator), with(contact_table, ",", separator));
}

TEST_F(Csv, ColumnsAreFoundByNameInAnyOrderAndSpelling)
{
  expect_the_same(
      "# made by hand\n\nT[s], ID, d[m], \"y\", x, omegaz[1/s], vy, vx, colour\n"
      "0.5,7,0.1,0.2,0.1,-3,2,1,5\n0.5,9,0.1,0.105,0.1,0,0,0,5\n"
      "0.6,9,0.1,0.105,0.1,0,0,0,5\n0.6,7,0.1,0.21,0.1,-3,2,1,5\n",
      with(contact_table, "i,j", "id1,id2"));
}

TEST_F(Csv, MomentsAreMatchedByTime)
{
  const auto archive = open_csv(files(grain_table, with(contact_table, "0.5,", "0.55,")));
  ASSERT_EQ(all_of(*archive).size(), 1u);
  EXPECT_EQ(archive->remarks().size(), 2u);
}

TEST_F(Csv, PeriodIsGivenAboveTheNames)
{
  const auto moment = read("# periodic: x 0 0.35\n" + grain_table, contact_table).at(0);
  EXPECT_EQ(moment.periodic, (std::array<bool, 3>{true, false, false}));
  EXPECT_EQ(moment.high.x() - moment.low.x(), 0.35);
  EXPECT_FALSE(read(grain_table, contact_table).at(0).periodic[0]);
  EXPECT_NE(complaint("# periodic: x 1 0\n" + grain_table, contact_table).find("not of the form"),
            std::string::npos);
}

TEST_F(Csv, WallsAreNegativeAndHaveABranch)
{
  const std::string wall = "t j i fx fy bx by\n0.5 -3 7 0 1 0 0.05\n";
  const auto contacts = read(grain_table, wall).at(0).contacts;
  EXPECT_EQ(contacts.wall[0], 2);
  EXPECT_EQ(contacts.branch[0], Vec3(0, 0.05, 0));
  EXPECT_NE(complaint(grain_table, "t i j fx fy\n0.5 7 -3 0 1\n").find("needs its branch"),
            std::string::npos);
}

TEST_F(Csv, DamageIsNamedByLine)
{
  const auto grains = [&](const std::string& text) { return complaint(text, contact_table); };
  EXPECT_NE(grains("").find("the table is empty"), std::string::npos);
  EXPECT_NE(grains("time,id,x,vx,vy\n").find("no column y"), std::string::npos);
  EXPECT_NE(grains(with(grain_table, "radius", "r,d,t")).find("two columns are named time"),
            std::string::npos);
  EXPECT_NE(grains(with(grain_table, "0.6,9,", "0.6,")).find("line 4: a row of 7 numbers"),
            std::string::npos);
  EXPECT_NE(grains(with(grain_table, "0.6", "0.4")).find("time 0.4 comes after time 0.5"),
            std::string::npos);
  EXPECT_NE(
      grains(with(grain_table, "0.5,7", "0.5,7.5")).find("row 1 of that time: 7.5 is not an id"),
      std::string::npos);
  EXPECT_NE(grains(with(grain_table, "0.105", "nan")).find("'nan' in column 4"), std::string::npos);
  auto all = files(grain_table.substr(0, grain_table.size() - 4), contact_table);
  EXPECT_THROW(all_of(*open_csv(all)), TruncatedArchive);
}

}  // namespace
}  // namespace grseg
