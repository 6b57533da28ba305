// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive.hpp"
#include "formats/import/convert/importer.hpp"
#include "formats/import/dump/contact_columns.hpp"
#include "formats/import/liggghts/liggghts_columns.hpp"
#include "formats/trajectory/reader.hpp"
#include "tests/formats/import/archive_balance.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace grseg {
namespace {

namespace fs = std::filesystem;
using namespace archive_balance;

const std::string inputs = GRSEG_TEST_INPUTS "/liggghts/";
const Vec3 pull = 9.81 * Vec3(0.390731, 0, -0.920505);
constexpr const char* full =
    "pos,vel,id,force,force_normal,force_tangential,torque,history,contactArea,delta,contactPoint";

DumpHeader header_of(std::size_t columns, const std::string& compute = "c_cp")
{
  DumpHeader header;
  header.place = "contacts.dump, line 1";
  for (std::size_t k = 1; k <= columns; ++k)
    header.columns.push_back(compute + "[" + std::to_string(k) + "]");
  return header;
}

std::string refusal(const std::string& columns, const DumpHeader& header)
{
  try {
    return liggghts_mapping(columns, header);
  } catch (const UsageError& error) {
    return error.what();
  }
}

class Liggghts : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("grseg_liggghts_" + std::to_string(getpid()));
  void SetUp() override { fs::create_directory(folder); }
  void TearDown() override { fs::remove_all(folder); }

  static ArchiveFiles files(const std::string& contacts, const std::string& columns = "")
  {
    ArchiveFiles all;
    all.grains = {inputs + "atoms.dump"};
    all.contacts = {inputs + contacts};
    all.columns = columns;
    return all;
  }
  ImportSettings settings(const ArchiveFiles& archive) const
  {
    ImportSettings s;
    s.format = "liggghts";
    s.files = archive;
    s.units = "si";
    s.step = 5e-6;
    s.gravity = fmt::format("{},{},{}", pull.x(), pull.y(), pull.z());
    s.axes = "xz";
    s.species.boundary = "3";
    s.output = (folder / "run.h5").string();
    s.overwrite = true;
    return s;
  }
};

TEST(LiggghtsColumns, AreInTheOrderOfTheSourceWhateverTheOrderOfTheKeywords)
{
  const auto header = header_of(13);
  const std::string mapping = "i=7,j=8,fx=10,fy=11,fz=12,overlap=13";
  EXPECT_EQ(liggghts_mapping("pos,id,force,delta", header), mapping);
  EXPECT_EQ(liggghts_mapping("delta,force,id,pos", header), mapping);
}

TEST(LiggghtsColumns, DeltaIsBeforeTheContactPoint)
{
  // The manual lists contactArea, heatFlux, contactPoint, and no delta.
  EXPECT_EQ(liggghts_mapping("id,force,contactPoint,delta,contactArea", header_of(11)),
            "i=1,j=2,fx=4,fy=5,fz=6,overlap=8");
}

TEST(LiggghtsColumns, PresetsAreTheKnownSelections)
{
  EXPECT_EQ(liggghts_mapping("liggghts-default", header_of(25)), "i=13,j=14,fx=16,fy=17,fz=18");
  EXPECT_EQ(liggghts_mapping("liggghts-full35", header_of(35)),
            "i=13,j=14,fx=16,fy=17,fz=18,overlap=32");
  EXPECT_EQ(liggghts_mapping("forcechain12", header_of(12)), "i=7,j=8,fx=10,fy=11,fz=12");
}

TEST(LiggghtsColumns, PartsOfTheForceAreAddedWhereTheWholeIsMissing)
{
  EXPECT_EQ(liggghts_mapping("id,force_tangential,force_normal", header_of(9)),
            "i=1,j=2,fx=4,fy=5,fz=6,tx=7,ty=8,tz=9");
}

TEST(LiggghtsColumns, LengthOfTheHistoryDependsOnTheModel)
{
  EXPECT_EQ(liggghts_mapping("id,force,history:1,delta", header_of(8)),
            "i=1,j=2,fx=4,fy=5,fz=6,overlap=8");
  EXPECT_NE(refusal("id,force,history:x", header_of(8)).find("not a keyword"), std::string::npos);
}

TEST(LiggghtsColumns, WithoutVelocitiesTheSameNumberMeansSomethingElse)
{
  // In files of version 1.5.1, c_cp[13] is in the middle of the force by default.
  const auto header = header_of(19);
  EXPECT_NE(refusal("liggghts-default", header).find("25 columns"), std::string::npos);
  EXPECT_EQ(liggghts_mapping("pos,id,force,torque,history,contactArea", header),
            "i=7,j=8,fx=10,fy=11,fz=12");
}

TEST(LiggghtsColumns, WhatIsMissingIsNamed)
{
  EXPECT_NE(refusal("pos,force", header_of(9)).find("id, and force"), std::string::npos);
  EXPECT_NE(refusal("id,forces", header_of(6)).find("'forces' is not a keyword"),
            std::string::npos);
  EXPECT_NE(refusal("id,force", header_of(12)).find("6 columns"), std::string::npos);
  EXPECT_NE(refusal("id,force", header_of(6, "v_x")).find("fx=4"), std::string::npos)
      << "names that do not tell count from the left";
}

TEST_F(Liggghts, EverySelectionOfColumnsIsTheSameContacts)
{
  const auto whole = all_of(*liggghts_format.open(files("contacts-full35.dump")));
  ASSERT_EQ(whole.size(), 4u);
  for (const char* name : {"default25", "forcechain12", "part"}) {
    const bool part = std::string(name) == "part";
    const auto read = all_of(
        *liggghts_format.open(files("contacts-" + std::string(name) + ".dump", part ? full : "")));
    ASSERT_EQ(read.size(), whole.size()) << name;
    for (std::size_t k = 0; k < read.size(); ++k) {
      EXPECT_EQ(read[k].contacts.i, whole[k].contacts.i) << name;
      EXPECT_EQ(read[k].contacts.j, whole[k].contacts.j) << name;
      EXPECT_EQ(read[k].contacts.force, whole[k].contacts.force) << name;
    }
  }
}

TEST_F(Liggghts, GrainsBalanceWithinTheErrorOfReevaluatedForces)
{
  double worst = 0;
  for (const auto& frame : all_of(*liggghts_format.open(files("contacts-full35.dump")))) {
    auto mobile = frame;
    for (const auto type : frame.grains.type) mobile.grains.fixed.push_back(type == 3);
    worst = std::max(worst, residual(mobile, pull));
  }
  EXPECT_LT(worst, 0.007);
  EXPECT_GT(worst, 1e-4);
}

TEST_F(Liggghts, OverlapIsDeltaNotADifferenceOfRoundedPositions)
{
  const auto frame_of = [this](const char* contacts) {
    const auto s = settings(files(contacts));
    import_archive(s, "grseg-import");
    const TrajectoryReader run(s.output);
    Frame<2> frame;
    run.read(3, frame);
    return frame;
  };
  const auto stated = frame_of("contacts-full35.dump").contacts;
  const auto found = frame_of("contacts-default25.dump").contacts;
  ASSERT_EQ(stated.size(), 4u);  // two more contacts are between grains of the base
  EXPECT_EQ(stated.gap[0], -5.6389e-05);
  // Differences of the positions, which have 6 digits, are off by 2e-8.
  for (std::size_t c = 0; c < stated.size(); ++c) EXPECT_NEAR(stated.gap[c], found.gap[c], 1e-10);
}

TEST_F(Liggghts, AWrongReadingIsRefusedAndTheRightOneNamed)
{
  const auto s = settings(files("contacts-full35.dump", "i=13,j=14,force=22"));
  try {
    import_archive(s, "grseg-import");
    ADD_FAILURE() << "friction alone should not balance";
  } catch (const CheckError& error) {
    EXPECT_NE(std::string(error.what()).find("with --columns liggghts-full35"), std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(fs::exists(s.output));
}

TEST_F(Liggghts, AnUnknownNumberOfColumnsNeedsAMapping)
{
  const auto archive = liggghts_format.open(files("contacts-part.dump"));
  ArchiveFrame frame;
  ASSERT_TRUE(archive->next(frame));
  ASSERT_EQ(frame.questions.size(), 1u);
  EXPECT_EQ(frame.questions[0].option, "--columns MAP");
  EXPECT_EQ(frame.contacts.size(), 0u);
}

TEST_F(Liggghts, NamesOfColumnsThatDoNotFitTheRowsAreNotAskedForAMapping)
{
  std::ifstream file(inputs + "contacts-full35.dump");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  text.at(text.find("c_cp[2] c_cp[3]") + 7) = '$';
  const auto damaged = (folder / "contacts.dump").string();
  std::ofstream(damaged) << text;
  auto archive = files("contacts-full35.dump");
  archive.contacts = {damaged};
  ArchiveFrame frame;
  try {
    liggghts_format.open(archive)->next(frame);
    ADD_FAILURE() << "34 names and 35 numbers";
  } catch (const FormatError& error) {
    EXPECT_EQ(error.what(), damaged + ", line 10: a row of 35 columns, but the header names 34");
  }
}

DumpHeader named_header(const std::string& names)
{
  DumpHeader header;
  header.place = "contacts.dump, line 1";
  std::istringstream words(names);
  for (std::string word; words >> word;) header.columns.push_back(word);
  return header;
}

const std::string first_18 = "x1 y1 z1 x2 y2 z2 vx1 vy1 vz1 vx2 vy2 vz2 id1 id2 periodic fx fy fz ";

TEST(LiggghtsColumns, AreToldFromThoseOfLammps)
{
  const auto is_of_liggghts = [](const std::string& names) {
    return are_of_liggghts(named_header(names).columns);
  };
  EXPECT_TRUE(is_of_liggghts("c_cp[13] c_cp[14] c_cp[16] c_cp[17] c_cp[18]"));
  EXPECT_TRUE(is_of_liggghts("index c_cp[7] c_cp[8] c_cp[10] c_cp[11] c_cp[12]"));
  EXPECT_TRUE(is_of_liggghts(first_18 + "delta"));
  EXPECT_TRUE(is_of_liggghts("id1 id2 periodic fx fy fz"));
  EXPECT_FALSE(is_of_liggghts("index c_pr[1] c_pr[2] c_pl[1] c_pl[2]"));
  EXPECT_FALSE(is_of_liggghts("index c_pl[1] c_pl[2] c_pl[3] c_pl[4]"));
  EXPECT_FALSE(is_of_liggghts("n id1 id2 t1 t2 dist fnx fny fnz ftx fty ftz ft"));
}

TEST(LiggghtsColumns, OfTheComputeMayStandBesideTheIndex)
{
  const auto header = named_header("index c_cp[7] c_cp[8] c_cp[10] c_cp[11] c_cp[12]");
  EXPECT_EQ(liggghts_mapping("pos,id,force", header), "i=2,j=3,fx=4,fy=5,fz=6");
}

// The names fit a preset in ids and force, but not in the following columns, whose order the preset
// defines.
TEST_F(Liggghts, NamesOfColumnsChooseAmongTheKnownOnes)
{
  auto all = files("contacts-full35.dump");
  std::ifstream in(all.contacts[0]);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const auto columns_of = [&](const std::string& names) {
    auto renamed = text;
    for (auto at = renamed.find("c_cp[1]"); at != std::string::npos; at = renamed.find("c_cp[1]"))
      renamed.replace(at, renamed.find('\n', at) - at, names);
    all.contacts = {(folder / "named.dump").string()};
    std::ofstream(all.contacts[0]) << renamed;
    const auto archive = liggghts_format.open(all);
    ArchiveFrame frame;
    EXPECT_TRUE(archive->next(frame));
    EXPECT_TRUE(frame.questions.empty());
    return archive->columns();
  };
  const std::string rest = "fnx fny fnz ftx fty ftz tx ty tz a b c h1 h2 h3 area delta";
  EXPECT_EQ(columns_of(first_18 + rest), "liggghts-full35");
  EXPECT_EQ(columns_by_name(named_header("id1 id2 fx fy fz " + rest), PlainForce::whole),
            "i=id1,j=id2,fx=fx,fy=fy,fz=fz,overlap=delta");
}

}  // namespace
}  // namespace grseg
