// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that grseg-import writes from every format meet the specification: grseg-check --deep passes them.
#include "formats/trajectory/reader.hpp"
#include "tests/formats/import/lammps_text.hpp"
#include "tests/formats/import/mercury_files.hpp"
#include "tests/shell.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace grseg {
namespace {

const std::string inputs = GRSEG_TEST_INPUTS;

class ImportedFile : public testing::Test {
 protected:
  lammps_text::Folder folder;

  void expect_as_specified(const std::string& options, const std::string& more = "") const
  {
    const auto run = folder / "run.h5";
    const auto imported =
        shell::run(fmt::format("cd {} && {} {} --units si --overwrite --quiet {} -o {} 2>&1",
                               inputs, GRSEG_IMPORT, options, more, run));
    ASSERT_EQ(imported.code, 0) << options << ": " << imported.out;
    const auto checked =
        shell::run(fmt::format("{} {} --deep -o /dev/null --quiet 2>&1", GRSEG_CHECK, run));
    EXPECT_EQ(checked.code, 0) << options << more << ": " << checked.out;
  }
};

TEST_F(ImportedFile, OfLammpsIsAsSpecified)
{
  const std::string run = "--step 1e-5 --gravity 9.8 --slope 23 --boundary 3";
  const std::string columns = " --columns i=2,j=3,dist=6,force=7,tangential=10";
  for (const char* more : {"", " --float32", " --compression 6"})
    expect_as_specified(
        "--format lammps --grains lammps/atoms.dump --contacts "
        "lammps/contacts.dump " +
            run + columns,
        more);
  expect_as_specified(
      "--format lammps --grains lammps/elastic-atoms.dump.gz --contacts "
      "lammps/elastic-contacts.dump.zst " +
      run + columns);
}

TEST_F(ImportedFile, OfLiggghtsIsAsSpecifiedWhateverColumnsItHas)
{
  const std::string run =
      " --format liggghts --grains liggghts/atoms.dump --step 5e-6 --gravity "
      "3.8330711,0,-9.03015405 --axes xz --boundary 3 --contacts liggghts/contacts-";
  for (const char* contacts : {"full35.dump", "default25.dump", "forcechain12.dump"})
    expect_as_specified(run + contacts);
}

TEST_F(ImportedFile, OfSiconosIsAsSpecified)
{
  const std::string run = "--format siconos --gravity 9.81 ";
  expect_as_specified(run + "--slope 10 --cell x:-0.1:0.9 --grains siconos/discs.hdf5");
}

TEST_F(ImportedFile, OfSpheresInSpaceIsAsSpecifiedWhateverTheSpecies)
{
  const std::string run =
      "--format lammps --grains lammps3d/atoms.dump.gz --contacts lammps3d/contacts.dump.gz --step "
      "8.8e-4 --gravity 0.5299192642332049,0,-0.848048096156426 --axes xz --boundary 1";
  for (const char* more : {"", " --species AM=2 --species SE=3:1.9 --species X=4:0.1",
                           " --species grains=all", " --float32"})
    expect_as_specified(run, more);
  expect_as_specified(
      "--format siconos --grains siconos/spheres3d.hdf5 --gravity 1.7034886,0,-9.6609641 --axes xz "
      "--cell x:-0.1:0.7 --cell y:-0.1:0.5");
}

TEST_F(ImportedFile, OfMercuryDpmIsAsSpecified)
{
  const TrajectoryReader sample(inputs + "/../../data/sample/chute.h5");
  std::string data, fstat;
  for (const std::size_t k : {5U, 6U, 7U}) {
    Frame<2> frame;
    sample.read(k, frame);
    data += mercury_files::data(sample.grains(), sample.box(), frame, {});
    fstat += mercury_files::fstat(sample.grains(), frame, {});
  }
  expect_as_specified(
      fmt::format("--format mercury --grains {} --contacts {} --restart {} --accept-residual 10",
                  folder.write("run.data", data), folder.write("run.fstat", fstat),
                  folder.write("run.restart", mercury_files::restart(sample.grains(), sample))));
}

/// A grain at rest on a fixed one, at two times.
TEST_F(ImportedFile, OfPlainTablesIsAsSpecified)
{
  const auto grains = folder.write("grains.csv",
                                   "time,id,x,y,radius,mass,vx,vy,omega,fixed,fx,fy\n"
                                   "0.5,7,0.1,0.2,0.05,0.4,0,0,0,0,0,0\n"
                                   "0.5,9,0.1,0.1,0.05,0.4,0,0,0,1,0,0\n"
                                   "0.6,7,0.1,0.2,0.05,0.4,0,0,0,0,0,0\n"
                                   "0.6,9,0.1,0.1,0.05,0.4,0,0,0,1,0,0\n");
  const auto contacts = folder.write("contacts.csv",
                                     "time,i,j,fx,fy,overlap\n"
                                     "0.5,7,9,0,4,0\n0.6,7,9,0,4,0\n");
  expect_as_specified(
      fmt::format("--format csv --grains {} --contacts {} --step 1e-3 --gravity 0,-10,0 "
                  "--grains-are discs --split-diameter 0.2 --cell x:0:0.4",
                  grains, contacts));
}

}  // namespace
}  // namespace grseg
