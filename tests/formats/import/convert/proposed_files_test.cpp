// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/scan.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using namespace lammps_text;

/// Files whose names contradict their content.
class NamedFiles : public testing::Test {
 protected:
  Folder folder;
  const std::string grains = folder.write("contacts.dump", grains_at(0));
  const std::string contacts = folder.write("atoms.dump", contacts_at(0));

  ImportSettings unnamed(const std::string& format, const std::vector<std::string>& files) const
  {
    ImportSettings s;
    s.format = format;
    s.output = folder / "run.h5";
    s.files.unnamed = files;
    return s;
  }
  std::string asked(const ImportSettings& s) const
  {
    Questions questions;
    try {
      with_proposed_files(s, questions);
      questions.report();
    } catch (const OpenQuestions& open) {
      return open.options();
    } catch (const ToolError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(NamedFiles, OfAKnownProgramAreTakenForWhatTheyHold)
{
  for (const char* format : {"lammps", "liggghts"}) {
    const auto s = with_known_files(unnamed(format, {contacts, grains}));
    EXPECT_EQ(s.files.grains, std::vector{grains}) << format;
    EXPECT_EQ(s.files.contacts, std::vector{contacts}) << format;
    EXPECT_TRUE(s.files.unnamed.empty());
    EXPECT_EQ(asked(unnamed(format, {contacts, grains})), "");
  }
}

TEST_F(NamedFiles, AreNotAskedForAgain)
{
  EXPECT_EQ(asked(unnamed("", {contacts})),
            "--format lammps --contacts " + contacts + " --grains FILES");
  EXPECT_EQ(asked(unnamed("lammps", {contacts})), "--grains FILES");
  EXPECT_EQ(asked(unnamed("lammps", {grains})), "--contacts FILES");
}

TEST_F(NamedFiles, OfLammpsAndLiggghtsAreToldByTheirColumns)
{
  const auto written_by = [&](const std::string& columns) {
    const auto said =
        asked(unnamed("", {grains, folder.write("c", block("ENTRIES", 0, columns, {}))}));
    return said.substr(0, said.find(" --grains"));
  };
  EXPECT_EQ(written_by("n id1 id2 t1 t2 dist fnx fny fnz ftx fty ftz"), "--format lammps");
  EXPECT_EQ(written_by("index c_a[1] c_a[2] c_b[1] c_b[2]"), "--format lammps");
  EXPECT_EQ(written_by("x1 y1 z1 x2 y2 z2 id1 id2 periodic fx fy fz"), "--format liggghts");
  EXPECT_EQ(written_by("c_c[1] c_c[2] c_c[3] c_c[4] c_c[5] c_c[6]"), "--format liggghts");
}

/// An HDF5 file with these groups.
std::string hdf5_with(const std::string& path, const std::vector<std::string>& groups)
{
  hdf5::silence();
  const hdf5::File file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  for (const auto& group : groups) hdf5::make_group(file, group);
  return path;
}

TEST_F(NamedFiles, OfUnknownHdf5AreNamedWithTheirGroups)
{
  const auto said = [&](const std::vector<std::string>& groups) {
    return asked(unnamed("", {hdf5_with(folder / "a.h5", groups)}));
  };
  EXPECT_TRUE(mentions(said({"bodies", "links"}),
                       "a.h5 is an HDF5 file of unknown layout, with 'bodies, links' in its root: "
                       "write its grains and contacts as tables (--format csv)"));
  EXPECT_TRUE(mentions(said({}), "with nothing in its root"));
  EXPECT_TRUE(mentions(said({"CreatorData", "TimestepData"}), "is an HDF5 file of EDEM: write"));
  EXPECT_TRUE(mentions(said({"Step#0", "Step#1"}), "is an H5Part file: write"));
  EXPECT_TRUE(mentions(said({"Evolution", "Simulation", "Help"}), "--format lmgc90"));
}

TEST_F(NamedFiles, ThatNoFormatKnowsAreNamedWithTheirFirstLine)
{
  const auto text = folder.write("notes.txt", "what I did\n");
  EXPECT_TRUE(mentions(
      asked(unnamed("", {grains, text})),
      text + ": its content is not recognised by its first line, 'what I did'; name it with "
             "--grains or --contacts, and its --format (lammps, liggghts, "));
  const auto late = folder.write("late.txt", " \n\nwhat I did\n");
  EXPECT_TRUE(mentions(asked(unnamed("", {late})), "by its first line, 'what I did'; name it"));
  EXPECT_TRUE(mentions(asked(unnamed("", {late})), "files of other programs must become tables"));
  EXPECT_TRUE(mentions(asked(unnamed("liggghts", {grains, text})),
                       "is not recognised as that of --format liggghts"));
  const auto table = folder.write("c.csv", "i,j,fx,fy\n");
  EXPECT_TRUE(mentions(asked(unnamed("", {grains, table})), "the files are not of one program"));
  auto s = unnamed("lammps", {grains});
  s.files.grains = {folder.write("more.dump", grains_at(100))};
  EXPECT_TRUE(mentions(
      asked(s), grains + " also belongs to the files with the grains: name it behind --grains"));
}

}  // namespace
}  // namespace grseg
