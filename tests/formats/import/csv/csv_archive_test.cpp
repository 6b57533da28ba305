// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive.hpp"
#include "tests/formats/import/archive_balance.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

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
  std::vector<ArchiveFrame> read(const std::string& grains, const std::string& contacts) const
  {
    return all_of(*csv_format.open(files(grains, contacts)));
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
  const auto frames = read(grains, contacts);
  ASSERT_EQ(frames.size(), 2u) << grains;
  const auto& first = frames[0];
  EXPECT_EQ(*first.time, 0.5);
  EXPECT_EQ(first.grains.id, (std::vector<std::int64_t>{7, 9}));
  EXPECT_EQ(first.grains.position[0], Vec3(0.1, 0.2, 0));
  EXPECT_EQ(first.grains.radius, (std::vector<double>{0.05, 0.05}));
  EXPECT_EQ(first.grains.velocity[0], Vec3(1, 2, 0));
  EXPECT_EQ(first.grains.angular_velocity[0], Vec3(0, 0, -3));
  EXPECT_EQ(first.contacts.force[0], Vec3(0.25, -4, 0));
  EXPECT_EQ(first.contacts.i[0], 7);
  EXPECT_EQ(first.contacts.j[0], 9);
  EXPECT_EQ(frames[1].grains.id, (std::vector<std::int64_t>{9, 7}));
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

TEST_F(Csv, FramesAreMatchedByTime)
{
  const auto archive = csv_format.open(files(grain_table, with(contact_table, "0.5,", "0.55,")));
  ASSERT_EQ(all_of(*archive).size(), 1u);
  EXPECT_EQ(archive->remarks().size(), 2u);
}

TEST_F(Csv, PeriodIsGivenAboveTheNames)
{
  const auto frame = read("# periodic: x 0 0.35\n" + grain_table, contact_table).at(0);
  EXPECT_EQ(frame.periodic, (std::array<bool, 3>{true, false, false}));
  EXPECT_EQ(frame.high.x() - frame.low.x(), 0.35);
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
  EXPECT_NE(grains(with(grain_table, "0.6,9,", "0.6,")).find("line 4: a row of 7 fields"),
            std::string::npos);
  EXPECT_NE(grains(with(grain_table, "0.6", "0.4")).find("time 0.4 comes after time 0.5"),
            std::string::npos);
  EXPECT_NE(
      grains(with(grain_table, "0.5,7", "0.5,7.5")).find("row 1 of this frame: 7.5 is not an id"),
      std::string::npos);
  EXPECT_NE(grains(with(grain_table, "0.105", "nan")).find("'nan' in column 4"), std::string::npos);
  auto all = files(grain_table.substr(0, grain_table.size() - 4), contact_table);
  EXPECT_THROW(all_of(*csv_format.open(all)), TruncatedArchive);
}

/// One file per step; its name ends in the step.
class CsvPerStep : public Csv {
 protected:
  void write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  ArchiveFiles named(const std::string& grains, const std::string& contacts) const
  {
    ArchiveFiles all;
    all.grains = {(folder / grains).string()};
    all.contacts = {(folder / contacts).string()};
    return all;
  }
  std::string complaint_of(const ArchiveFiles& all) const
  {
    try {
      all_of(*csv_format.open(all));
    } catch (const ToolError& error) {
      return error.what();
    }
    return "no complaint";
  }
};

TEST_F(CsvPerStep, WindowsTablesHaveAMarkSemicolonsCommasInNumbersAndNoLastLineEnd)
{
  const std::string mark = "\xef\xbb\xbf";
  for (const int step : {900, 1000}) {
    write(fmt::format("grains_{:06}.csv", step),
          mark + "id;x;y;radius;vx;vy\r\n7;0,1;0,2;0,05;1;2\r\n9;0,1;0,105;0,05;0;-1,5e-3");
    write(fmt::format("contacts_{:06}.csv", step), mark + "i;j;fx;fy\r\n7;9;0,25;-4");
  }
  const auto frames = all_of(*csv_format.open(named("grains_*.csv", "contacts_*.csv")));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(*frames[0].step, 900);
  EXPECT_EQ(*frames[1].step, 1000);
  EXPECT_FALSE(frames[0].time);
  EXPECT_EQ(frames[1].grains.position[1], Vec3(0.1, 0.105, 0));
  EXPECT_EQ(frames[1].grains.velocity[1].y(), -1.5e-3);
  EXPECT_EQ(frames[1].contacts.force[0], Vec3(0.25, -4, 0));
}

TEST_F(CsvPerStep, TheStepIsWhatTheStarStandsForWhateverDigitsElseTheNameHas)
{
  for (const char* step : {"9", "10", "11"}) {
    write(fmt::format("mu0.5_{}_v2.csv", step), "id,x,y,d,vx,vy\n7,0,0,1,0,0\n");
    write(fmt::format("c{}.csv", step), "i,j,fx,fy\n7,9,0,0\n");
  }
  const auto frames = all_of(*csv_format.open(named("mu0.5_*_v2.csv", "c*.csv")));
  ASSERT_EQ(frames.size(), 3u);
  std::vector<std::int64_t> steps;
  for (const auto& frame : frames) steps.push_back(*frame.step);
  EXPECT_EQ(steps, (std::vector<std::int64_t>{9, 10, 11}));
}

TEST_F(CsvPerStep, ANumberWithAPointIsATime)
{
  for (const char* time : {"0.5", "0.75"}) {
    write(fmt::format("g{}.csv", time), "id,x,y,d,vx,vy\n7,0,0,1,0,0\n");
    write(fmt::format("c{}.csv", time), "i,j,fx,fy\n7,9,0,0\n");
  }
  const auto frames = all_of(*csv_format.open(named("g*.csv", "c*.csv")));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(*frames[1].time, 0.75);
  EXPECT_FALSE(frames[1].step);
}

TEST_F(CsvPerStep, TimesAndStepsDoNotMatchAndNamesWithoutEitherAreRefused)
{
  write("g1.csv", "id,x,y,d,vx,vy\n7,0,0,1,0,0\n");
  write("grains.csv", "id,x,y,d,vx,vy\n7,0,0,1,0,0\n");
  write("c.csv", contact_table);
  EXPECT_NE(
      complaint_of(named("g1.csv", "c.csv")).find("has times, but the table of grains has steps"),
      std::string::npos)
      << complaint_of(named("g1.csv", "c.csv"));
  EXPECT_NE(complaint_of(named("grains.csv", "c.csv")).find("no column time among"),
            std::string::npos);
}

TEST_F(CsvPerStep, FilesInUtf16AreNamed)
{
  write("g1.csv", std::string("\xff\xfei\0d\0", 6));
  EXPECT_NE(complaint_of(named("g1.csv", "g1.csv")).find("is text in UTF-16: save it as UTF-8"),
            std::string::npos);
}

TEST_F(Csv, IndexColumnsQuotationMarksAndTruthValuesAreThoseOfPandas)
{
  const auto frames = read(
      ",\"time\",\"id\",\"name\",\"x\",\"y\",\"radius\",\"vx\",\"vy\",\"omega\",fixed\n"
      "0,0.5,7,\"a, b\",0.1,0.2,0.05,1,2,-3,False\n1,0.5,9,,0.1,0.105,0.05,0,0,0,True\n",
      contact_table);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].grains.fixed, (std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(frames[0].grains.position[1], Vec3(0.1, 0.105, 0));
}

TEST_F(Csv, TextAndUnitsInBracketsMayStandBesideTheNumbers)
{
  const auto frames = read(
      "t [s]\tID\tmaterial\tx (m)\ty (m)\tradius (m)\tvx\tvy\tomega\n"
      "0.5\t7\tglass bead\t0.1\t0.2\t0.05\t1\t2\t-3\n0.5\t9\t\t0.1\t0.105\t0.05\t0\t0\t0\n",
      contact_table);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].grains.position[0], Vec3(0.1, 0.2, 0));
}

TEST_F(Csv, AMapGivesOtherNamesAndLeavesColumnsOut)
{
  auto all = files(
      "Cycle,Ball ID,x,pos_x,pos_y,Radius,velx,vely,fx\n100,7,4,0.1,0.2,0.05,1,2,12\n"
      "100,9,4,0.1,0.105,0.05,0,0,12\n",
      "Cycle,particle1,particle2,Force(x),Force(y),t\n100,7,9,0.25,-4,text\n");
  all.map = {"Ball ID=id,pos_x=x,pos_y=y,velx=vx",
             "vely=vy,particle1=i,particle2=j,fx=,t=", "Force(x)=fx,Force(y)=fy"};
  const auto frames = all_of(*csv_format.open(all));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(*frames[0].step, 100);
  EXPECT_EQ(frames[0].grains.position[0], Vec3(0.1, 0.2, 0));
  EXPECT_EQ(frames[0].grains.velocity[0], Vec3(1, 2, 0));
  EXPECT_TRUE(frames[0].grains.force.empty());
  EXPECT_EQ(frames[0].contacts.force[0], Vec3(0.25, -4, 0));
}

TEST_F(Csv, AMapThatFitsNothingIsRefused)
{
  auto all = files(grain_table, contact_table);
  const auto said = [&](const std::string& map) {
    all.map = {map};
    try {
      all_of(*csv_format.open(all));
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("no complaint");
  };
  EXPECT_NE(said("particle1").find("is neither NAME=COLUMN"), std::string::npos);
  EXPECT_NE(said("particle1=i").find("no table has a column of that name"), std::string::npos);
  EXPECT_NE(said("x=raduis").find("radius"), std::string::npos) << said("x=raduis");
  EXPECT_EQ(said("omega="), "no complaint");
}

TEST_F(Csv, APointAndACommaInOneTableAreRefused)
{
  const std::string names = "time;id;x;y;radius;vx;vy\n";
  EXPECT_NE(complaint(names + "0,5;7;0,1;0.2;0,05;1;2\n", contact_table)
                .find("a decimal point or a decimal comma, the same in the whole table"),
            std::string::npos);
  EXPECT_NE(complaint(names + "0.5;7;1.234,5;0.2;0.05;1;2\n", contact_table)
                .find("'1.234,5' in column 3 ('x') is not a finite number"),
            std::string::npos);
}

TEST_F(Csv, ManyFilesWithTheirTimesMayEachHaveNamesOrNot)
{
  auto all = files(grain_table, contact_table);
  std::ofstream(folder / "part1.csv")
      << "time,id,x,y,radius,vx,vy,omega\n0.5,7,0.1,0.2,0.05,1,2,-3\n";
  std::ofstream(folder / "part2.csv") << "0.5,9,0.1,0.105,0.05,0,0,0\n";
  std::ofstream(folder / "part3.csv") << "time,id,y,x,radius,vx,vy\n0.6,9,0.105,0.1,0.05,0,0\n";
  all.grains = {(folder / "part*.csv").string()};
  const auto frames = all_of(*csv_format.open(all));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].grains.size(), 2u);
  EXPECT_EQ(frames[1].grains.position[0], Vec3(0.1, 0.105, 0));
}

TEST_F(Csv, CommentsAboveTheNamesStateFactsOfTheRun)
{
  const auto open = [&](const std::string& comments) {
    return csv_format.open(files(comments + grain_table, contact_table));
  };
  const auto archive =
      open("# gravity: 3.8 -9 0\n# step: 1e-5\n# units: si\n# grains: discs\n# by hand\n");
  const auto& facts = archive->facts();
  EXPECT_EQ(*facts.gravity, Vec3(3.8, -9, 0));
  EXPECT_EQ(*facts.step, 1e-5);
  EXPECT_EQ(*facts.units, "si");
  EXPECT_TRUE(*facts.discs);
  for (const char* line :
       {"# gravity: 9.8\n", "# step: -1\n", "# units: feet\n", "# grains: cubes\n"})
    EXPECT_THROW(open(line), FormatError) << line;
}

TEST_F(Csv, ColumnsThatAreMissingAreNamedInOneAnswer)
{
  const auto sentence = complaint("time,pos.x,radius\n", "time,end1,j\n");
  for (const char* part :
       {"grains.csv, line 1: no columns id, x, vx, y, vy among 'time pos.x radius'",
        "--map NAME=id,NAME=x,NAME=vx,NAME=y,NAME=vy names them", "row=id",
        "contacts.csv, line 1: no columns i, fx, fy among 'time end1 j'"})
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  EXPECT_NE(complaint("time,id,x,y,vx\n", contact_table).find("no column vy among"),
            std::string::npos);
}

TEST_F(Csv, ColumnsWithoutAKnownMeaningAreAskedFor)
{
  const auto grains = with(with(grain_table, "omega\n", "omega,pos.z\n"), "-3\n", "-3,0\n");
  const auto frames = read(with(grains, "0,0,0\n", "0,0,0,0\n"), contact_table);
  ASSERT_EQ(frames[0].questions.size(), 1u);
  EXPECT_EQ(frames[0].questions[0].option, "--map pos.z=");
  EXPECT_TRUE(frames[1].questions.empty());
}

TEST_F(Csv, ColumnsOfOtherShapesAreRefused)
{
  const auto grains = with(with(grain_table, "omega\n", "omega,ShapeX\n"), "-3\n", "-3,1\n");
  EXPECT_NE(complaint(with(grains, "0,0,0\n", "0,0,0,1\n"), contact_table)
                .find("single discs or spheres, and the table has ShapeX"),
            std::string::npos);
}

TEST_F(Csv, NumbersMayBeThoseOfFortran)
{
  const auto with_d = [](std::string table) {
    return with(with(table, "0.5,", "5.0D-01,"), "0.05,", "0.05D0,");
  };
  const auto frames = read("# step: 1.0D-05\n# periodic: x 0.0D0 0.35D0\n" + with_d(grain_table),
                           with(with_d(contact_table), "0.25", "2.5-001"));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(*frames[0].time, 0.5);
  EXPECT_EQ(frames[0].high.x(), 0.35);
  EXPECT_EQ(frames[0].grains.radius, (std::vector<double>{0.05, 0.05}));
  EXPECT_DOUBLE_EQ(frames[0].contacts.force[0].x(), 0.25);
}

TEST_F(Csv, IdsMayBeBeyondTheIntegersOfMostPrograms)
{
  const auto frames = read(with(grain_table, ",7,0.1", ",4294967303,0.1"),
                           with(contact_table, "7,9", "4294967303,9"));
  EXPECT_EQ(frames.at(0).grains.id[0], 4294967303);
  EXPECT_EQ(frames.at(0).contacts.i[0], 4294967303);
  EXPECT_NE(
      complaint(with(grain_table, ",7,0.1", ",1e16,0.1"), contact_table).find("1e+16 is not an id"),
      std::string::npos);
}

TEST_F(Csv, FramesThatDoNotMatchAreNamed)
{
  const auto said = complaint(grain_table, with(contact_table, "0.5,7", "0.500003,7"));
  EXPECT_EQ(said, "no complaint") << "those of 0.6 match";
  const auto later = with(with(contact_table, "0.5,7", "0.500003,7"), "0.6,7", "0.600003,7");
  EXPECT_EQ(
      complaint(grain_table, later),
      "no frame is in both tables: the grains begin with 0.5, 0.6, the contacts with 0.500003, "
      "0.600003; write both at the same times");
  EXPECT_EQ(complaint(grain_table, "time,i,j,fx,fy\n"), "no complaint")
      << "there is nothing to match";
}

TEST_F(Csv, StepsOfManyDigitsAreNamedExactly)
{
  const auto at = [](std::string table, const std::string& first, const std::string& second) {
    table = with(with(table, "time,", "step,"), "0.5,", first + ",");
    return with(table, "0.6,", second + ",");
  };
  EXPECT_EQ(complaint(at(grain_table, "12345678901", "12345679901"),
                      at(contact_table, "12345678951", "12345679951")),
            "no frame is in both tables: the grains begin with 12345678901, 12345679901, the "
            "contacts with 12345678951, 12345679951; write both at the same times");
}

// One program writes a time as 0, another as round-off.
TEST_F(Csv, TimesAreTheSameToABillionthOfWhatIsBetweenThem)
{
  const auto at = [](const std::string& table, const char* time) {
    return with(table, "0.5,", time);
  };
  EXPECT_EQ(read(at(grain_table, "0,"), at(contact_table, "1.0-101,")).size(), 2u);
  EXPECT_EQ(read(at(grain_table, "0,"), at(contact_table, "1e-9,")).size(), 1u);
}

TEST_F(Csv, TypesMayBeWords)
{
  const auto typed = [](const std::string& types) {
    std::istringstream words(types);
    std::string table = "time,id,x,y,vx,vy,Particle Type\n", word;
    for (const char* row :
         {"0.5,7,0.1,0.2,1,2,", "0.5,9,0.1,0.1,0,0,", "0.6,7,0.1,0.2,1,2,", "0.6,9,0.1,0.1,0,0,"}) {
      words >> word;
      table += row + word + "\n";
    }
    return table;
  };
  const auto grains_of = [&](const std::string& types, std::size_t frame) {
    auto all = files(typed(types), contact_table);
    all.map = {"ParticleType=type"};
    return all_of(*csv_format.open(all)).at(frame).grains;
  };
  const auto words = grains_of("coarse fine coarse fine", 1);
  EXPECT_EQ(words.type, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(words.type_names, (std::vector<std::string>{"coarse", "fine"}));
  const auto both = grains_of("3 wall 3.0 wall", 1);
  EXPECT_EQ(both.type_word(both.type[0]) + both.type_word(both.type[1]), "3wall");
  const auto numbers = grains_of("3 4 3.0 4", 1);
  EXPECT_EQ(numbers.type, (std::vector<std::int32_t>{3, 4}));
  EXPECT_TRUE(numbers.type_names.empty());
  for (const char* types : {"1.5 2 1.5 2", "nan fine nan fine", "1e10 2 1e10 2"})
    EXPECT_THROW(grains_of(types, 0), FormatError) << types;
  EXPECT_THROW(grains_of("3 4 3 wall", 1), FormatError) << "words after numbers";
}

/// Tables without a line of names.
class CsvWithoutNames : public Csv {
 protected:
  const std::string contact_rows = contact_table.substr(contact_table.find('\n') + 1);
  std::vector<ArchiveFrame> mapped(const std::vector<std::string>& map,
                                   const std::string& separator = ",") const
  {
    auto all = files(with(grain_rows, ",", separator), with(contact_rows, ",", separator));
    all.map = map;
    return all_of(*csv_format.open(all));
  }
};

TEST_F(CsvWithoutNames, ColumnsAreNamedByNumber)
{
  for (const char* separator : {",", ";", "\t", " "}) {
    const auto frames = mapped(
        {"1=time,2=id,3=x,4=y,5=radius,6=vx,7=vy,8=omega", "1=time,2=i,3=j,4=fx,5=fy,6=overlap"},
        separator);
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[0].grains.size(), 2u) << "the first line is a row";
    EXPECT_EQ(frames[0].grains.position[0], Vec3(0.1, 0.2, 0));
    EXPECT_TRUE(frames[0].grains.force.empty()) << "column 4 is fx in the other table";
    EXPECT_EQ(frames[0].contacts.force[0], Vec3(0.25, -4, 0));
  }
}

TEST_F(CsvWithoutNames, OneListForBothTablesIsDividedByTheNamesThatOneAloneHas)
{
  const auto frames = mapped({"1=time,2=id,3=x,4=y,5=radius,6=vx,7=vy,8=omega,2=i,3=j,4=fx,5=fy"});
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].grains.position[0], Vec3(0.1, 0.2, 0));
  EXPECT_EQ(frames[0].contacts.force[0], Vec3(0.25, -4, 0));
}

TEST_F(CsvWithoutNames, ArePointedOutUntilTheirColumnsAreNamed)
{
  EXPECT_NE(
      complaint(grain_rows, contact_table)
          .find("line 1: the first line contains numbers, not names: name the columns with --map "
                "1=id,2=x,..."),
      std::string::npos);
  EXPECT_NE(complaint(grain_table, contact_rows).find("name the columns with --map 1=i,2=j,..."),
            std::string::npos);
  auto all = files(grain_table, contact_table);
  all.map = {"3=x,12=y"};
  EXPECT_THROW(csv_format.open(all), UsageError) << "there is no column 12";
}

TEST_F(CsvWithoutNames, MayHaveThemInTheCommentAbove)
{
  for (const char* sign : {"# ", "#", "% "}) {
    const auto frames = read(sign + with(grain_table, ",", " "),
                             "# by hand\n" + (sign + with(contact_table, ",", " ")));
    ASSERT_EQ(frames.size(), 2u) << sign;
    EXPECT_EQ(frames[0].grains.position[0], Vec3(0.1, 0.2, 0));
    EXPECT_EQ(frames[0].contacts.force[0], Vec3(0.25, -4, 0));
  }
}

TEST_F(Csv, TheNumberOfARowMayBeTheId)
{
  const auto grains = with(with(grain_table, ",7,0.1", ",0.1"), ",9,0.1", ",0.1");
  auto all = files(with(grains, ",id", ""), contact_table);
  const auto ids = [&](const std::string& map) {
    all.map = {map};
    std::vector<std::int64_t> found;
    for (const auto& frame : all_of(*csv_format.open(all)))
      found.insert(found.end(), frame.grains.id.begin(), frame.grains.id.end());
    return found;
  };
  EXPECT_EQ(ids("row=id"), (std::vector<std::int64_t>{0, 1, 0, 1}));
  EXPECT_EQ(ids("row+1=id"), (std::vector<std::int64_t>{1, 2, 1, 2}));
  EXPECT_THROW(ids("row=x"), UsageError);
  EXPECT_NE(complaint(with(grains, ",id", ""), contact_table).find("--map row=id"),
            std::string::npos);
  all = files(grain_table, contact_table);
  EXPECT_EQ(ids("row=id"), (std::vector<std::int64_t>{0, 1, 0, 1})) << "the table has other ids";
}

}  // namespace
}  // namespace grseg
