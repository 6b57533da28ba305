// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/dump_reader.hpp"

#include "formats/import/common/archive_files.hpp"
#include "formats/import/dump/dump_grains.hpp"
#include "formats/import/dump/dump_pair.hpp"
#include "tests/folder.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <fmt/ranges.h>
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
    JoinedDumps dump({folder.write("atoms.dump", text)});
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
  EXPECT_TRUE(mentions(with("2 0.5", "ITEM: T"), "line 11: 1 of 2 rows of step 5 are missing"));
  EXPECT_TRUE(mentions(with("1 0.5", "0x1 0.5"), "line 10: '0x1' in column 1 (id)"));
  EXPECT_TRUE(mentions(with("ATOMS\n2", "ATOMS\n3"), "line 11: the archive ends in a row"));
  EXPECT_TRUE(mentions(with("ATOMS\n2", "ATOMS\n-2"), "line 4: '-2' is not a number of rows"));
  EXPECT_TRUE(mentions(with("TIMESTEP\n5", "TIMESTEP\n5.5"), "line 2: '5.5' is not a time step"));
  EXPECT_TRUE(mentions(with("0 0.1", "0 nan"), "line 6: '0 nan' is not a pair of bounds"));
  EXPECT_TRUE(mentions(with("0 0.1", "0 0.1 0.02"), "line 6: the cell is tilted"));
  EXPECT_TRUE(
      mentions(with("ITEM: NUMBER", "ITEM: SUM"), "line 3: 'ITEM: SUM OF ATOMS' is not part"));
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
  EXPECT_TRUE(mentions(pair.remarks()[0], "3 frames have grains but no contacts"));
  EXPECT_TRUE(mentions(pair.remarks()[1], "2 frames have contacts but no grains"));
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

TEST_F(Dump, StepsThatNoDumpSharesAreNamed)
{
  const auto blocks = [&](const char* name, const std::vector<int>& steps) {
    std::string text;
    for (const int step : steps) text += block(name, step, "id x", {"1 0.5"});
    return folder.write(name, text);
  };
  DumpPair pair({blocks("ATOMS", {0, 100, 200, 300})}, {blocks("ENTRIES", {50, 150})});
  try {
    pair.next();
    FAIL() << "no step is in both";
  } catch (const FormatError& error) {
    EXPECT_TRUE(mentions(error.what(),
                         "the grains begin with 0, 100, 200, the contacts with 50, 150; write both "
                         "at the same times"));
  }
}

TEST_F(Dump, StepsOfManyDigitsAreNamedExactly)
{
  const auto dump = [&](const char* name, const std::vector<std::int64_t>& steps) {
    std::string text;
    for (const auto step : steps) text += block(name, step, "id x", {"1 0.5"});
    return folder.write(name, text);
  };
  const std::int64_t first = 12345678901, second = 9007199254740993;
  DumpPair pair({dump("ATOMS", {first, second})}, {dump("ENTRIES", {second})});
  EXPECT_TRUE(pair.next());
  EXPECT_FALSE(pair.next());
  EXPECT_TRUE(mentions(fmt::format("{}", fmt::join(pair.remarks(), "; ")),
                       "are left out, the first at step 12345678901"));
  DumpPair apart({dump("ATOMS", {first})}, {dump("ENTRIES", {first + 1, second})});
  EXPECT_TRUE(mentions(complaint_of<FormatError>([&] { apart.next(); }),
                       "the grains begin with 12345678901, the contacts with 12345678902, "
                       "9007199254740993;"));
}

TEST_F(Dump, NumbersMayBeThoseOfFortranAndIdsBeyond32Bits)
{
  const auto grains =
      grains_of(block("ATOMS", 0, "id x y radius", {"4294967303 0.5D-01 2.0-102 1.0D0"}));
  EXPECT_EQ(grains.id[0], 4294967303);
  EXPECT_EQ(grains.position[0], Vec3(0.05, 2e-102, 0));
  EXPECT_EQ(grains.radius[0], 1);
}

TEST_F(Dump, TypesMayBeWords)
{
  for (const char* column : {"type", "typelabel"}) {
    const auto grains = grains_of(block("ATOMS", 0, std::string("id x ") + column,
                                        {"1 0.5 glass", "2 0.5 sand", "3 0.5 glass"}));
    EXPECT_EQ(grains.type, (std::vector<std::int32_t>{0, 1, 0})) << column;
    EXPECT_EQ(grains.type_names, (std::vector<std::string>{"glass", "sand"})) << column;
  }
  const auto both = grains_of(block("ATOMS", 0, "id x type typelabel", {"1 0.5 3 glass"}));
  EXPECT_EQ(both.type, (std::vector<std::int32_t>{3}));
  EXPECT_TRUE(both.type_names.empty());
  EXPECT_THROW(grains_of(block("ATOMS", 0, "id x type", {"1 0.5 1.5"})), FormatError);
}

// `dump_modify triclinic/general yes` writes the edges of the cell, each with a coordinate of its origin.
TEST_F(Dump, ACellGivenByItsEdgesIsReadWhereItIsRectangular)
{
  const auto dump = [](const std::string& edges) {
    return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS abc origin pp ff ps\n" +
           edges + "ITEM: ATOMS id x\n1 0.5\n";
  };
  DumpReader reader({folder.write("a.dump", dump("2 0 1e-16 -1\n0 3 0 0.5\n0 0 4 -2\n"))});
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.header().low, Vec3(-1, 0.5, -2));
  EXPECT_EQ(reader.header().high, Vec3(1, 3.5, 2));
  EXPECT_EQ(reader.header().periodic, (std::array<bool, 3>{true, false, false}));
  EXPECT_TRUE(mentions(complaint(dump("2 0 0 -1\n0.5 3 0 0\n0 0 4 0\n")),
                       "line 7: the cell is tilted; only rectangular cells are imported"));
  EXPECT_TRUE(mentions(complaint(dump("2 0 0 -1\n-3 0 0 0\n0 0 4 0\n")), "the cell is tilted"));
  EXPECT_TRUE(mentions(complaint(dump("2 0 -1\n0 3 0\n0 0 4\n")),
                       "line 6: '2 0 -1' is not an edge of the cell and its origin"));
}

/// Two steps of two grains and two contacts, in files of two processors.
class DumpOfProcessors : public Dump {
 protected:
  std::string write(const std::string& name, const std::string& label,
                    const std::vector<int>& steps, const std::string& row)
  {
    std::string text;
    for (const int step : steps)
      text += block(label, step, label == "ATOMS" ? "id x" : "i j fx", {row});
    return folder.write(name, text);
  }
  /// First column of the rows at each step, as "0: 1 2; 100: 1 2; ".
  static std::string first_column(const std::vector<std::string>& files)
  {
    JoinedDumps dump(files);
    std::string text;
    std::vector<std::vector<double>> values;
    while (dump.next()) {
      dump.read_rows(std::vector<std::size_t>{0}, values);
      text += fmt::format("{}: {}; ", dump.header().step, fmt::join(values[0], " "));
    }
    return text;
  }
  static std::string complaint_about(const std::vector<std::string>& files)
  {
    try {
      first_column(files);
    } catch (const FormatError& error) {
      return error.what();
    }
    return "no complaint";
  }
};

TEST_F(DumpOfProcessors, PartsOfAStepAreJoined)
{
  const auto a = write("a.0.dump", "ATOMS", {0, 100}, "1 0.5");
  const auto b = write("a.1.dump", "ATOMS", {0, 100}, "2 0.5");
  EXPECT_EQ(first_column({a, b}), "0: 1 2; 100: 1 2; ");
  std::vector<std::string> files;
  for (const int step : {0, 100})
    for (const int processor : {0, 1})
      files.push_back(write(fmt::format("s.{}.{}", step, processor), "ATOMS", {step},
                            fmt::format("{} 0.5", processor + 1)));
  EXPECT_EQ(first_column(files), "0: 1 2; 100: 1 2; ");
  EXPECT_EQ(archive_files({folder / "s.*.%"}, "--grains"), files);
  std::swap(files[1], files[2]);
  EXPECT_EQ(first_column(files), "0: 1 2; 100: 1 2; ") << "processor by processor";
  EXPECT_EQ(first_column({write("e.0", "ATOMS", {0}, "1 0.5"), folder.write("e.1", "")}), "0: 1; ")
      << "a processor without grains";
}

TEST_F(DumpOfProcessors, FilesThatFollowOneAnotherAreInOrderOfTheirSteps)
{
  EXPECT_EQ(
      first_column({write("b", "ATOMS", {200, 300}, "3 0"), write("c", "ATOMS", {0, 100}, "4 0")}),
      "0: 4; 100: 4; 200: 3; 300: 3; ");
}

// In a dump local, LAMMPS writes the header only in the file of the first processor.
TEST_F(DumpOfProcessors, RowsWithoutAHeaderBelongToTheStepInTheirName)
{
  std::vector<std::string> files;
  for (const int step : {0, 100}) {
    files.push_back(write(fmt::format("c.{}.0", step), "ENTRIES", {step}, "1 2 0"));
    files.push_back(
        folder.write(fmt::format("c.{}.1", step), fmt::format("{} 4 0\n5 6 0\n", step + 3)));
    files.push_back(folder.write(fmt::format("c.{}.2", step), ""));
  }
  EXPECT_EQ(first_column(files), "0: 1 3 5; 100: 1 103 5; ");
  const auto all = write("d.0", "ENTRIES", {0, 100}, "1 2 0");
  const auto rows = folder.write("d.1", "3 4 0\n");
  EXPECT_TRUE(mentions(
      complaint_about({all, rows}),
      rows + " has no header, because LAMMPS writes it only for the first processor, and " + all));
}

TEST_F(DumpOfProcessors, AFileThatIsDamagedIsNotLeftOut)
{
  const auto a = write("a", "ATOMS", {0}, "1 0.5");
  EXPECT_TRUE(mentions(complaint_about({a, folder.write("b.gz", "\x1f\x8b cut off")}),
                       "the compressed data is damaged or truncated"));
}

TEST_F(DumpOfProcessors, WhatIsNotPartOfOneDumpIsNamed)
{
  const auto a = write("a", "ATOMS", {0, 100}, "1 0.5");
  EXPECT_TRUE(mentions(complaint_about({a, write("c", "ENTRIES", {0, 100}, "1 2 0")}),
                       "these files begin with the same step, but are not parts of one dump"));
  EXPECT_TRUE(mentions(complaint_about({a, write("b", "ATOMS", {0}, "2 0.5")}),
                       "this part of the dump ends behind step 0"));
}

}  // namespace
}  // namespace grseg
