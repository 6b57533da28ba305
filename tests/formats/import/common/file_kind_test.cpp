// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive.hpp"
#include "formats/import/common/archive_files.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace grseg {
namespace {

using namespace std::string_literals;
using lammps_text::mentions;

std::string complaint_about(const std::string& path)
{
  try {
    refuse_other_kind(path);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "no complaint";
}

std::string complaint_of(const std::string& format, const ArchiveFiles& files)
{
  try {
    ArchiveFrame frame;
    while (open_archive(format, files)->next(frame)) {
    }
  } catch (const ToolError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(FileKind, IsRecognisedByTheFirstBytes)
{
  const std::pair<std::string, const char*> starts[] = {
      {"PK\x03\x04", "a zip archive, as xlsx, ods and npz are"},
      {"PAR1\x15", "a table of Parquet"},
      {"CDF\x01\0"s, "a netCDF file"},
      {"CDF\x05\0"s, "a netCDF file"},
      {"# vtk DataFile Version 2.0\nby hand\nASCII\n", "a VTK file"},
      {"<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">\n", "a VTK file"},
      {"<VTKFile type=\"PolyData\">\n", "a VTK file"},
      {"<?xml version=\"1.0\"?>\n<Xdmf>\n", "an XML file"},
      {"---\ncreator: LAMMPS\ntimestep: 0\n", "a YAML file"},
      {"[{\"id\": 1}]", "a JSON file"},
      {std::string(257, '\0').append("ustar"), "a tar archive"},
      {"GiD Post Results File 1.0\n\nResult", "a file of GiD, as Kratos writes it: write its"},
      {"MESH \"Kratos_Mesh\" dimension 3", "a file of GiD"},
      {"Begin ModelPartData\nEnd ModelPartData\n", "a model of Kratos (mdpa)"},
      {"LSMGeometry 1.2\nBoundingBox 0 0", "a file of ESyS-Particle"},
      {"V 3\n0 1e-4 2\n", "a file of ESyS-Particle"},
      {"\x54\0\0\0CORD"s, "a DCD file, which contains positions only"},
      {"\x04\x22\x4d\x18",
       "packed by lz4: decompress it, or compress it by gzip, bzip2, xz or "
       "zstd"},
      {"2\nAtoms. Timestep: 0\n1 0.01 0.01 0\n", "an xyz file"},
      {"2\nLattice=\"1 0 0\"\r\nSi 0 0 0 1\r\n", "an xyz file"},
      {"made by hand\n\n12 atoms\n2 atom types\n0 1 xlo xhi\n", "a data file of LAMMPS"},
      {"\0\0\0\0\x5a\0\0\0Version LIGGGHTS-PUBLIC"s, "a restart file of LIGGGHTS"},
      {"version https://git-lfs.github.com/spec/v1\n", "a pointer of Git LFS"},
      {"\xff\xfei\0d\0"s, "text in UTF-16: save it as UTF-8"},
      {"i\0d\0,\0x\0"s, "is not text: turn a binary dump into text by binary2txt"},
  };
  for (const auto& [start, kind] : starts) EXPECT_TRUE(mentions(other_kind(start), kind));
}

TEST(FileKind, OfTextThatIsReadHasNoName)
{
  for (const char* start :
       {"", "ITEM: TIMESTEP\n0\n", "time,id,x,y\n0,1,0,0\n", "\xef\xbb\xbfid;x\n",
        "2 0.5 0 0 1 1\n0.1 0.2 0 0 0.05 0 -1 0\n", "# 0.5 1\n# 0 0 0 1 1 0\n",
        "MercuryDPM 0.14 name chute\n", "2\n1\n2 3\n", "% by hand\n",
        // Letters that also begin files in binary.
        "# RECORDED by hand\nid,x\n", "PAR1,PAR2\n1,2\n", "FEA1 FEA2\n", "LZIP,id\n", "ARROW1\tx\n",
        "time id DUMPATOM\n", "%PDF,x\n"})
    EXPECT_EQ(other_kind(start), "") << start;
}

/// Files in tests/inputs/kinds.
TEST(FileKind, OfFilesThatLammpsAndH5pyWroteIsNamed)
{
  const std::string at = GRSEG_TEST_INPUTS "/kinds/";
  const std::pair<const char*, const char*> files[] = {
      {"atoms.bin", "a binary dump of LAMMPS: turn it into text by binary2txt"},
      {"atoms.restart", "a restart file of LAMMPS: read it in that program; then `run 0` with a"},
      {"atoms.data", "a data file of LAMMPS"},
      {"atoms.cfg", "a file of AtomEye (cfg)"},
      {"atoms.xyz", "an xyz file"},
      {"other.h5md", "an H5MD file of another program, without contacts"}};
  for (const auto& [name, kind] : files)
    EXPECT_TRUE(mentions(complaint_about(at + name), at + name + " is " + kind));
  EXPECT_EQ(complaint_about(GRSEG_TEST_INPUTS "/siconos/discs.hdf5"), "no complaint");
  EXPECT_THROW(refuse_other_kind(GRSEG_TEST_INPUTS "/three-grains-closed.h5"), UsageError);
}

TEST(FileKind, OfBinaryContentThatNothingTellsFollowsFromTheName)
{
  const lammps_text::Folder folder;
  const auto content = "\x07\0\0\0state"s;
  EXPECT_TRUE(mentions(complaint_about(folder.write("bed.p3sav", content)),
                       "bed.p3sav is a saved state of a program of Itasca: write its grains"));
  EXPECT_TRUE(mentions(complaint_about(folder.write("bed.mdem", content)), "a file of MUSEN: "));
  const auto other = complaint_about(folder.write("bed.bin", content));
  EXPECT_TRUE(mentions(other, "is not text"));
  EXPECT_TRUE(mentions(other, "output of other programs as tables (--format csv)"));
  EXPECT_EQ(complaint_about(folder.write("bed.sav", "id,x\n1,2\n")), "no complaint");
}

TEST(FileKind, IsRecognisedWhicheverFormatWasNamedAndInAnyFile)
{
  const lammps_text::Folder folder;
  const auto zip = folder.write("a.zip", "PK\x03\x04 and more");
  const auto dump = folder.write("a.dump", lammps_text::grains_at(0));
  for (const auto* format : archive_formats()) {
    ArchiveFiles files;
    files.grains = {zip};
    EXPECT_TRUE(mentions(complaint_of(format->name, files), "is a zip archive")) << format->name;
  }
  ArchiveFiles files;
  files.grains = {dump};
  files.contacts = {zip};
  EXPECT_TRUE(mentions(complaint_of("lammps", files), zip + " is a zip archive"));
}

TEST(FileKind, IsRecognisedInsideACompressedFileToo)
{
  namespace io = boost::iostreams;
  const lammps_text::Folder folder;
  const auto packed = [](const std::string& text) {
    std::string out;
    io::filtering_ostream to;
    to.push(io::gzip_compressor());
    to.push(io::back_inserter(out));
    io::copy(io::array_source(text.data(), text.size()), to);
    return out;
  };
  std::string tar(257, '\0');
  tar += "ustar";
  EXPECT_TRUE(mentions(complaint_about(folder.write("a.tar.gz", packed(tar))),
                       "is a tar archive: unpack it"));
  EXPECT_TRUE(mentions(complaint_about(folder.write("a.gz.gz", packed(packed("ITEM: TIMESTEP\n")))),
                       "is packed twice: unpack it once"));
}

TEST(FileKind, AFileThatCanBeReadOnlyOnceIsRefused)
{
  const lammps_text::Folder folder;
  const auto path = folder / "pipe.dump";
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  try {
    refuse_other_kind(path);
    FAIL() << "a pipe was taken";
  } catch (const UsageError& error) {
    EXPECT_TRUE(mentions(error.what(), "is a pipe or a device, which can be read only once"));
  }
}

}  // namespace
}  // namespace grseg
