// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/reader.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

#include <random>

namespace grseg {
namespace {

using namespace lammps_text;

/// Damaged archives of two frames; each is refused with its message, and nothing is written.
class DamagedArchive : public testing::Test {
 protected:
  Folder folder;
  std::string grains = grains_at(0) + grains_at(100), contacts = contacts_at(0) + contacts_at(100);

  static void replace(std::string& text, const std::string& what, const std::string& by)
  {
    const auto at = text.rfind(what);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, what.size(), by);
  }
  /// The message and its exit code are listed in damaged_archives.tsv, beside `damage`.
  void expect_refusal(const std::string& damage, int code, const std::string& sentence)
  {
    auto refused = refusal(settings(folder, grains, contacts));
    const auto place = folder / "";
    for (auto at = refused.sentence.find(place); at != std::string::npos;
         at = refused.sentence.find(place))
      refused.sentence.erase(at, place.size());
    EXPECT_EQ(refused.code, code);
    EXPECT_TRUE(mentions(refused.sentence, sentence));
    EXPECT_EQ(folder.files(), 2u) << "something was written";
    const auto row = fmt::format("\n{}\t{}\t{}\n", damage, refused.sentence, refused.code);
    EXPECT_NE(sentences.find(row), std::string::npos)
        << "damaged_archives.tsv lacks the row" << row;
  }

 private:
  const std::string sentences =
      read(GRSEG_TEST_INPUTS "/../formats/import/convert/damaged_archives.tsv");
};

TEST_F(DamagedArchive, ThatIsWholeIsNotRefused)
{
  EXPECT_EQ(refusal(settings(folder, grains, contacts)).sentence, "");
}

TEST_F(DamagedArchive, TruncatedInARow)
{
  grains.resize(grains.size() - 20);
  expect_refusal("the grains end in a row", exit_content,
                 "atoms.dump, line 24: the archive ends in a row; copy it again");
}

TEST_F(DamagedArchive, TruncatedInAHeader)
{
  contacts = contacts_at(0) + "ITEM: TIMESTEP\n100\nITEM: NUMBER";
  expect_refusal("the contacts end in a header", exit_content,
                 "contacts.dump, line 14: the archive ends in a header");
}

TEST_F(DamagedArchive, BinaryNoise)
{
  std::mt19937 noise(1);
  for (auto& c : contacts) c = static_cast<char>(noise());
  expect_refusal("noise instead of contacts", exit_content, "this is not text: a binary dump?");
}

TEST_F(DamagedArchive, WrongNumberOfColumns)
{
  replace(grains, "7 2 ", "7 2 2 ");
  expect_refusal("a row with a column more", exit_content,
                 "atoms.dump, line 24: a row of 12 columns, but the header names 11");
}

TEST_F(DamagedArchive, NotANumber)
{
  replace(contacts, " 0.01 ", " nan ");
  expect_refusal("a NaN", exit_content, "contacts.dump, line 22: 'nan' in column 4 (c_pl[1])");
}

TEST_F(DamagedArchive, AFrameTwiceWithOtherPositions)
{
  contacts += contacts_at(100);
  grains += block("ATOMS", 100, grain_columns, grain_rows(0.06));
  expect_refusal("a frame twice, with other positions", exit_usage,
                 "step 100 comes after 100, and its grains are not where they were the first time");
}

TEST_F(DamagedArchive, UnitsThatDiffer)
{
  grains = "ITEM: UNITS\nsi\n" + grains;
  contacts = "ITEM: UNITS\ncgs\n" + contacts;
  expect_refusal("grains and contacts in different units", exit_content,
                 "the grains are in units 'si' and the contacts in units 'cgs'");
}

TEST_F(DamagedArchive, WithoutABase)
{
  while (grains.find("\n9 3") != std::string::npos) replace(grains, "\n9 3", "\n9 2");
  expect_refusal("no base", exit_usage, "no grain belongs to the base (types 3)");
}

TEST_F(DamagedArchive, IdsOfSixDigits)
{
  for (const char* id : {"\n7 ", "\n4 "})
    while (grains.find(id) != std::string::npos) replace(grains, id, "\n1.23457e+06 ");
  expect_refusal("two ids as %g writes them", exit_content, "was it written with six digits");
}

TEST_F(DamagedArchive, HugeNumberOfRows)
{
  replace(grains, "NUMBER OF ATOMS\n3", "NUMBER OF ATOMS\n2000000000");
  expect_refusal("a count of 2,000,000,000 rows", exit_content,
                 "line 24: the archive ends in a row");
  replace(grains, "2000000000", "99999999999999");
  expect_refusal("a count of 99,999,999,999,999 rows", exit_content,
                 "line 16: '99999999999999' is not a number of rows");
}

TEST_F(DamagedArchive, Empty)
{
  grains.clear();
  expect_refusal("empty", exit_content, "the archive has no frame with grains and contacts");
}

TEST_F(DamagedArchive, AMissingOrDuplicateGrain)
{
  const auto whole = grains;
  replace(grains, "\n7 2", "\n8 2");
  expect_refusal("another grain than before, and contacts of the old one", exit_content,
                 "a contact names grain 7, which is not among the grains of this frame");
  grains = whole;
  replace(grains, "\n7 2", "\n4 2");
  expect_refusal("a duplicate grain", exit_content, "grain 4 appears twice");
}

TEST_F(DamagedArchive, AContactOfAnUnknownGrain)
{
  replace(contacts, " 4 7 ", " 5 7 ");
  expect_refusal("a contact of an unknown grain", exit_content,
                 "a contact names grain 5, which is not among the grains of this frame");
}

TEST_F(DamagedArchive, ThatEndsInAFrameIsImportedUpToItOnRequest)
{
  grains.resize(grains.size() - 20);
  auto s = settings(folder, grains, contacts);
  s.drop_incomplete = true;
  EXPECT_EQ(import_archive(s, "").frames, 1u);
  EXPECT_EQ(TrajectoryReader(s.output).size(), 1u);
}

TEST_F(DamagedArchive, TruncatedAnywhereIsRefusedOrImportedWhole)
{
  auto s = settings(folder, grains, contacts);
  s.overwrite = true;
  const auto whole_frame = grains_at(0).size();
  for (std::size_t size = 0; size < grains.size(); ++size) {
    folder.write("atoms.dump", grains.substr(0, size));
    const auto refused = refusal(s);
    EXPECT_EQ(refused.code, size == whole_frame ? exit_done : exit_content)
        << size << ": " << refused.sentence;
  }
}

}  // namespace
}  // namespace grseg
