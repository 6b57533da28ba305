// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/dump_reader.hpp"

#include "formats/import/dump/dump_grains.hpp"
#include "formats/import/dump/dump_pair.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using lammps_text::block;
using lammps_text::mentions;

class Dump : public testing::Test {
 protected:
  lammps_text::Folder folder;

  ArchiveGrains grains_of(const std::string& text)
  {
    DumpReader dump({folder.write("atoms.dump", text)});
    EXPECT_TRUE(dump.next());
    ArchiveGrains grains;
    DumpGrains().read(dump, grains);
    return grains;
  }
  std::string complaint(const std::string& text)
  {
    try {
      DumpReader dump({folder.write("atoms.dump", text)});
      std::vector<std::vector<double>> values;
      const std::vector<std::size_t> first{0};
      while (dump.next()) dump.read_rows(first, values);
    } catch (const FormatError& error) {
      return error.what();
    }
    return "no complaint";
  }
};

TEST_F(Dump, HeaderGivesUnitsTimeStepAndWhichBoundariesArePeriodic)
{
  DumpReader dump(
      {folder.write("atoms.dump", "ITEM: UNITS\nsi\nITEM: TIME\n0.25\n" +
                                      block("ATOMS", 500, "id x", {"1 0.5"}, "pp fs mm"))});
  ASSERT_TRUE(dump.next());
  EXPECT_EQ(dump.units(), "si");
  EXPECT_EQ(dump.header().time, 0.25);
  EXPECT_EQ(dump.header().step, 500);
  EXPECT_EQ(dump.header().periodic, (std::array<bool, 3>{true, false, false}));
  EXPECT_EQ(dump.header().low, Vec3(0, -0.01, -0.0025));
  EXPECT_EQ(dump.header().columns, (std::vector<std::string>{"id", "x"}));
}

TEST_F(Dump, RowsMayBeSkippedAndHaveAnyLabel)
{
  DumpReader dump({folder.write("c.dump", block("CONTACTS", 1, "a b", {"1 2", "3 4"}) +
                                              block("CONTACTS", 2, "a b", {"5 6"}))});
  ASSERT_TRUE(dump.next());
  ASSERT_TRUE(dump.next());
  std::vector<std::vector<double>> values;
  dump.read_rows(std::vector<std::size_t>{1}, values);
  EXPECT_EQ(values, (std::vector<std::vector<double>>{{6}}));
  EXPECT_FALSE(dump.next());
}

TEST_F(Dump, PositionsMayBePlainUnwrappedOrScaledByTheCell)
{
  const auto plain = grains_of(block("ATOMS", 0, "id x y ix", {"1 0.05 0.02 -2"}));
  EXPECT_EQ(plain.position[0], Vec3(0.05, 0.02, 0));
  EXPECT_EQ(plain.image[0][0], -2);
  const auto unwrapped = grains_of(block("ATOMS", 0, "id xu yu", {"1 -0.15 0.02"}));
  EXPECT_EQ(unwrapped.position[0], Vec3(-0.15, 0.02, 0));
  EXPECT_TRUE(unwrapped.image.empty());
  const auto scaled = grains_of(block("ATOMS", 0, "id zs ys xs", {"1 0.5 0.25 0.5"}));
  EXPECT_TRUE(scaled.position[0].isApprox(Vec3(0.05, 0.0175, 0)));
}

TEST_F(Dump, RadiusMayBeGivenByTheDiameterAndUnknownColumnsMayHoldWords)
{
  const auto grains =
      grains_of(block("ATOMS", 0, "element diameter id x y", {"Si 0.01 12 0 0", "C 0.005 3 0 0"}));
  EXPECT_EQ(grains.radius, (std::vector<double>{0.005, 0.0025}));
  EXPECT_EQ(grains.id, (std::vector<std::int64_t>{12, 3}));
  EXPECT_TRUE(grains.force.empty());
  EXPECT_TRUE(grains.velocity.empty());
}

TEST_F(Dump, GrainsWithoutIdsOrPositionsAreRefused)
{
  EXPECT_THROW(grains_of(block("ATOMS", 0, "x y", {"0 0"})), FormatError);
  EXPECT_THROW(grains_of(block("ATOMS", 0, "id vx", {"1 0"})), FormatError);
  EXPECT_THROW(grains_of(block("ATOMS", 0, "id x", {"1.5 0"})), FormatError);
  EXPECT_THROW(grains_of(block("ATOMS", 0, "id x", {"1e300 0"})), FormatError);
}

TEST_F(Dump, SentencesNameTheLine)
{
  const auto good = block("ATOMS", 5, "id x", {"1 0.5", "2 0.5"});
  EXPECT_EQ(complaint(good + "\n"), "no complaint");
  const auto with = [&](const std::string& what, const std::string& by) {
    auto text = good;
    text.replace(text.find(what), what.size(), by);
    return complaint(text);
  };
  EXPECT_TRUE(
      mentions(with("2 0.5", "2 0.5 3"), "line 11: a row of 3 columns, but the header names 2"));
  EXPECT_TRUE(mentions(with("2 0.5", "ITEM: T"), "line 11: 'ITEM:' in column 1 (id)"));
  EXPECT_TRUE(mentions(with("1 0.5", "0x1 0.5"), "line 10: '0x1' in column 1 (id)"));
  EXPECT_TRUE(mentions(with("ATOMS\n2", "ATOMS\n3"), "line 11: the archive ends in a row"));
  EXPECT_TRUE(mentions(with("ATOMS\n2", "ATOMS\n-2"), "line 4: '-2' is not a number of rows"));
  EXPECT_TRUE(mentions(with("TIMESTEP\n5", "TIMESTEP\n5.5"), "line 2: '5.5' is not a time step"));
  EXPECT_TRUE(mentions(with("0 0.1", "0 nan"), "line 6: '0 nan' is not a pair of bounds"));
  EXPECT_TRUE(mentions(with("0 0.1", "0 0.1 0.02"), "line 6: the cell is tilted"));
  EXPECT_TRUE(
      mentions(with("ITEM: NUMBER", "ITEM: SUM"), "line 3: 'ITEM: SUM OF ATOMS' is not part"));
  EXPECT_TRUE(mentions(complaint(good + good), "line 13: step 5 comes after step 5"));
  EXPECT_TRUE(mentions(complaint("ITEM: UNITS\nsi\n" + good + "ITEM: UNITS\ncgs\n"),
                       "line 15: units 'cgs' after units 'si'"));
}

TEST_F(Dump, PairsAreMatchedByStepAndTheRestIsReported)
{
  const auto blocks = [&](const char* name, const std::vector<int>& steps) {
    std::string text;
    for (const int step : steps) text += block(name, step, "id x", {"1 0.5"});
    return folder.write(name, text);
  };
  DumpPair pair({blocks("ATOMS", {0, 100, 200, 400, 500})},
                {blocks("ENTRIES", {50, 100, 150, 400})});
  std::vector<std::int64_t> steps;
  while (pair.next()) {
    EXPECT_EQ(pair.grains().header().step, pair.contacts().header().step);
    steps.push_back(pair.grains().header().step);
  }
  EXPECT_EQ(steps, (std::vector<std::int64_t>{100, 400}));
  ASSERT_EQ(pair.remarks().size(), 2u);
  EXPECT_TRUE(mentions(pair.remarks()[0], "3 moments have grains but no contacts"));
  EXPECT_TRUE(mentions(pair.remarks()[1], "2 moments have contacts but no grains"));
}

TEST_F(Dump, TimesGiveTheLengthOfAStep)
{
  const auto at = [](const std::string& time, int step) {
    return "ITEM: TIME\n" + time + "\n" + block("ATOMS", step, "id x", {"1 0.5"});
  };
  const auto grains = folder.write("a", at("0.5", 1000) + at("0.75", 2000));
  const auto contacts = folder.write("c", block("ENTRIES", 1000, "i j", {}));
  EXPECT_EQ(DumpPair({grains}, {contacts}).step(), 0.25 / 1000);
}

}  // namespace
}  // namespace grseg
