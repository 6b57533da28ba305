// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive_files.hpp"
#include "tests/formats/import/archive_balance.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace grseg {
namespace {

namespace fs = std::filesystem;
using namespace archive_balance;
using lammps_text::mentions;

/// tests/inputs/lmgc90, texts by hand: a wall (JONCx, body 1), a disc on it (2) that carries another
/// (3), and a third on the wall (4); at rest, radius 0.1, 1000 kg/m^2.
const std::string sample = GRSEG_TEST_INPUTS "/lmgc90";
constexpr double weight = 1000 * std::numbers::pi * 0.01 * 9.81;

std::unique_ptr<Archive> open(const std::string& folder, const std::string& restart = "")
{
  ArchiveFiles files;
  files.grains = {folder + "/OUTBOX/DOF.OUT.*"};
  files.restart = restart;
  return lmgc90_format.open(files);
}

/// A copy of the sample in which a text of one of its files is replaced.
class ChangedLmgc90 : public testing::Test {
 protected:
  lammps_text::Folder folder;
  std::string run = folder / "run";

  void SetUp() override { fs::copy(sample, run, fs::copy_options::recursive); }

  void replace(const std::string& file, const std::string& old, const std::string& now) const
  {
    const auto path = run + "/" + file;
    auto text = lammps_text::read(path);
    const auto at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    std::ofstream(path, std::ios::binary) << text.replace(at, old.size(), now);
  }
  std::string complaint() const
  {
    try {
      all_of(*open(run));
    } catch (const ToolError& error) {
      return error.what();
    }
    return "no complaint";
  }
};

TEST(Lmgc90Archive, ForcesOfDiscsAtRestAreTheirWeights)
{
  const auto archive = open(sample);
  const auto frames = all_of(*archive);
  ASSERT_EQ(frames.size(), 1u);  // the velocities before step 1 are not known
  const auto& [step, time, low, high, periodic, cell, grains, contacts, place, questions] =
      frames[0];
  EXPECT_EQ(grains.id, (std::vector<std::int64_t>{2, 3, 4}));
  EXPECT_NEAR(grains.mass[0] * 9.81, weight, 1e-9 * weight);
  EXPECT_EQ(grains.position[1], Vec3(0, 0.3, 0));
  EXPECT_EQ(grains.force.at(2), Vec3(0, 0, 0));
  EXPECT_EQ(contacts.i, (std::vector<std::int64_t>{3, 2, 4}));
  EXPECT_EQ(contacts.wall, (std::vector<std::int32_t>{-1, 0, 0}));
  const double loads[] = {weight, 2 * weight, weight};
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_LT((contacts.force[c] - Vec3(0, loads[c], 0)).norm(), 1e-6 * weight);
  EXPECT_LT((contacts.branch[1] - Vec3(0, 0.1, 0)).norm(), 1e-15);
  EXPECT_EQ(*step, 2);
  EXPECT_NEAR(*time, 2e-3, 1e-15);
  EXPECT_NEAR(*archive->facts().step, 1e-3, 1e-12);
  EXPECT_EQ(*archive->facts().gravity, Vec3(0, -9.81, 0));
  EXPECT_EQ(archive->facts().walls, std::vector<std::string>{"body 1 (JONCx)"});
  EXPECT_TRUE(*archive->facts().discs);
}

// A body that moved by X with v was, when its contacts were found, at X - h v / 2. The tangent is
// (n_y, -n_x). A gap of 2e-5 at the next step, which closes at 1e-2 m/s, is 1e-5 wide at this one.
TEST_F(ChangedLmgc90, StateBelongsToTheDetectionOfContacts)
{
  const std::string none = " 0.0000000D+00";
  replace("OUTBOX/DOF.OUT.1", "X(1)=" + none, "X(1)= 0.1000000D-01");  // the wall's, not used
  replace("OUTBOX/DOF.OUT.2", " RBDY2        3\n$nodty\n NO3xx      1                X(1)=" + none,
          " RBDY2        3\n$nodty\n NO3xx      1                X(1)= 0.1000000D-01");
  replace("OUTBOX/DOF.OUT.2",
          "X(1)= 0.1000000D-01  X(2)=" + none + "  X(3)=" + none +
              "\n                             V(1)=" + none,
          "X(1)= 0.1000000D-01  X(2)=" + none + "  X(3)=" + none +
              "\n                             V(1)= 0.4000000D+00");
  replace("OUTBOX/Vloc_Rloc.OUT.2", "rlt/H" + none, "rlt/H-0.5000000D+01");
  replace("OUTBOX/Vloc_Rloc.OUT.2", "vln =" + none, "vln = 0.1000000D-01");
  replace("OUTBOX/Vloc_Rloc.OUT.2", "gapTT" + none, "gapTT 0.2000000D-04");
  const auto frame = all_of(*open(run)).at(0);
  EXPECT_LT((frame.grains.position[1] - Vec3(0.01 - 2e-4, 0.3, 0)).norm(), 1e-12);
  EXPECT_LT((frame.grains.force.at(1) - Vec3(400 * frame.grains.mass[1], 0, 0)).norm(), 1e-6);
  EXPECT_NEAR(frame.contacts.force[0].x(), -5, 1e-12);
  EXPECT_NEAR(frame.contacts.overlap[0], -1e-5, 1e-12);
}

// A drum of radius 0.5 around the discs: the disc at its bottom is 0.4 below its centre.
TEST_F(ChangedLmgc90, DrumIsAWall)
{
  replace("DATBOX/BODIES.DAT",
          "JONCx      1  color  VERTx  ax1 = 0.1000000D+01  ax2 = 0.5000000D-01",
          "xKSID      1  color  VERTx  byrd= 0.5000000D+00");
  replace("OUTBOX/Vloc_Rloc.OUT.2", "JONCx", "xKSID");
  const auto archive = open(run);
  const auto frame = all_of(*archive).at(0);
  EXPECT_EQ(archive->facts().walls, std::vector<std::string>{"body 1 (xKSID)"});
  EXPECT_LT((frame.contacts.branch[1] - Vec3(0, 0.1, 0)).norm(), 1e-15);
}

TEST_F(ChangedLmgc90, BodyWithPrescribedRestIsFixed)
{
  replace("DATBOX/DRV_DOF.DAT", " RBDY2      1", " RBDY2      4");
  EXPECT_EQ(all_of(*open(run)).at(0).grains.fixed, (std::vector<std::uint8_t>{0, 0, 1}));
  replace("DATBOX/DRV_DOF.DAT", "0.0000000E+00", "0.1000000E+00");  // it moves
  EXPECT_EQ(all_of(*open(run)).at(0).grains.fixed, (std::vector<std::uint8_t>{0, 0, 0}));
}

TEST_F(ChangedLmgc90, BodiesOfOtherShapesAreNamed)
{
  const std::string disc = " DISKx      1  color  BLEUx  byrd= 0.1000000D+00";
  replace("DATBOX/BODIES.DAT", disc, disc + "\n DISKb      2  color  BLEUx  byrd= 0.1000000D+00");
  EXPECT_TRUE(
      mentions(complaint(), "BODIES.DAT, line 21: body 2 has a contactor DISKb; grains can"));
  replace("DATBOX/BODIES.DAT", "DISKb", "DISKx");
  EXPECT_TRUE(mentions(complaint(), "body 2 is a cluster of several contactors"));
  replace("DATBOX/BODIES.DAT", disc, " POLYG      1  color  BLEUx  nb_vertex=      4");
  EXPECT_TRUE(
      mentions(complaint(), "body 2 has a contactor POLYG; grains can be bodies of one disc"));
}

TEST_F(ChangedLmgc90, DamageIsNamedWithItsPlace)
{
  replace("OUTBOX/DOF.OUT.2", " RBDY2        4\n", " RBDY2        5\n");
  EXPECT_TRUE(mentions(complaint(), "DOF.OUT.2, line 29: a body is missing before this line"));
  replace("OUTBOX/DOF.OUT.2", " RBDY2        5\n", " RBDY2        4\n");
  replace("OUTBOX/Vloc_Rloc.OUT.2", " RBDY2      3", " RBDY2      9");
  EXPECT_TRUE(mentions(complaint(), "the contact of bodies 9 and 2 is not one of a grain"));
  replace("OUTBOX/Vloc_Rloc.OUT.1", "rln/H", "rln  ");
  EXPECT_TRUE(mentions(complaint(), "'rln/H' and its number are missing before this line"));
  replace("OUTBOX/Vloc_Rloc.OUT.1", "$steps        1", "$steps        3");
  EXPECT_TRUE(mentions(complaint(), "this is step 3, but"));
  fs::remove(run + "/OUTBOX/Vloc_Rloc.OUT.1");
  EXPECT_TRUE(mentions(complaint(), "Vloc_Rloc.OUT.1"));
  fs::rename(run + "/DATBOX", run + "/BOX");
  EXPECT_TRUE(mentions(complaint(), "--restart BODIES.DAT"));
}

TEST_F(ChangedLmgc90, ContactWithDamagedLinesIsRefused)
{
  const std::string bodies = " RBDY2      3  DISKx", normal = "n(1)= 0.0000000D+00";
  replace("OUTBOX/Vloc_Rloc.OUT.2", bodies, " SBDY2      3  DISKx");
  EXPECT_TRUE(mentions(complaint(), "3 contacts begin ('$icdan'), but 2 have a line"));
  replace("OUTBOX/Vloc_Rloc.OUT.2", " SBDY2", " RBDY2");
  replace("OUTBOX/Vloc_Rloc.OUT.2", normal, "n(1)= 0.1000000D+01");
  EXPECT_TRUE(
      mentions(complaint(), "contact of bodies 3 and 2 has a normal whose length is not 1"));
  replace("OUTBOX/Vloc_Rloc.OUT.2", "n(1)= 0.1000000D+01", normal);
  for (const char* number : {"-9223372036854775808", "9223372036854775807", "0"}) {
    replace("OUTBOX/Vloc_Rloc.OUT.2", bodies, fmt::format(" RBDY2  {}  DISKx", number));
    EXPECT_TRUE(mentions(complaint(), "is not one of a grain and a grain or wall of")) << number;
    replace("OUTBOX/Vloc_Rloc.OUT.2", fmt::format(" RBDY2  {}  DISKx", number), bodies);
  }
  fs::rename(run + "/OUTBOX/DOF.OUT.2", run + "/OUTBOX/other");
  ArchiveFiles files;
  files.grains = {run + "/OUTBOX/other"};
  EXPECT_THROW(all_of(*lmgc90_format.open(files)), UsageError);
}

TEST_F(ChangedLmgc90, MassesAreAskedForWithoutDensities)
{
  fs::remove(run + "/DATBOX/BULK_BEHAV.DAT");
  const auto archive = open(run);
  const auto frame = all_of(*archive).at(1);
  EXPECT_TRUE(archive->remarks().empty());
  EXPECT_TRUE(frame.grains.mass.empty());
  EXPECT_TRUE(frame.grains.force.empty());
  EXPECT_FALSE(archive->facts().gravity);
}

TEST_F(ChangedLmgc90, StepsAfterAGapAreLeftOutOnlyIfMostWereWritten)
{
  auto archive = open(run);
  all_of(*archive);
  ASSERT_EQ(archive->remarks().size(), 1u);
  EXPECT_TRUE(mentions(archive->remarks()[0], "if the step before was not written: 1 of 2"));
  for (const char* file : {"DOF", "Vloc_Rloc"})
    replace(fmt::format("OUTBOX/{}.OUT.2", file), "$steps        2", "$steps        9");
  archive = open(run);
  EXPECT_EQ(all_of(*archive).size(), 2u);
  EXPECT_TRUE(archive->remarks().empty());
}

TEST(Lmgc90Archive, FilesAreRecognisedByTheirContent)
{
  const auto role = [](const std::string& file) {
    return lmgc90_format.role(read_start(sample + "/" + file));
  };
  EXPECT_EQ(role("OUTBOX/DOF.OUT.1"), FileRole::grains);
  EXPECT_EQ(role("OUTBOX/Vloc_Rloc.OUT.1"), FileRole::contacts);
  EXPECT_EQ(role("DATBOX/BODIES.DAT"), FileRole::restart);
  EXPECT_EQ(role("DATBOX/DRV_DOF.DAT"), FileRole::none);
}

}  // namespace
}  // namespace grseg
