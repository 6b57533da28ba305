// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are given to the wrong program.
#include "formats/core/errors.hpp"
#include "formats/trajectory/file_kind.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace grseg {
namespace {

std::string as_run(const std::string& start)
{
  return kind_of_start(start).instead_of("a run", "nothing known");
}

TEST(FileKind, ATableIsNamedWithTheProgramThatReadsIt)
{
  EXPECT_EQ(as_run("# program: grseg-micro 1.0.0\n# history: x\n"),
            "is a table of grseg-micro 1.0.0, not a run: grseg-derive reads it");
  EXPECT_EQ(as_run("# program: grseg-fit 1.0.0\n"),
            "is a table of grseg-fit 1.0.0, not a run: it is a result, which no program of grseg "
            "reads");
  EXPECT_EQ(as_run("# program: of somebody else\n"), "nothing known");
}

TEST(FileKind, ASceneIsKnownByItsFirstKey)
{
  const std::string scene = "is a scene file, not a run: grseg-sim simulates it";
  EXPECT_EQ(as_run("# a chute\n\n  size-ratio = 2\n"), scene);
  EXPECT_EQ(as_run("slope=23"), scene);
  for (const char* other : {"= 2\n", "time,id,x\n", "# only a comment\n", "a b = 2\n", ""})
    EXPECT_EQ(as_run(other), "nothing known") << other;
}

TEST(FileKind, WhatWasWantedIsNoComplaint)
{
  const auto table = kind_of_start("# program: grseg-stress 1.0.0\n");
  EXPECT_EQ(table.instead_of("a table", ""), "");
  EXPECT_EQ(kind_of_start("{\"columns\": []}").instead_of("a table", ""),
            "is JSON, as --json prints it, not a table: make the table without --json");
}

TEST(FileKind, ARunAndACheckpointAreToldApart)
{
  const auto path =
      (std::filesystem::temp_directory_path() / ("grseg_kind_" + std::to_string(getpid()) + ".h5"))
          .string();
  const auto with = [&](const std::vector<std::string>& groups) {
    {
      hdf5::silence();
      const hdf5::File file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
      for (const auto& group : groups) hdf5::make_group(file, group);
    }
    return kind_of_file(path).name;
  };
  EXPECT_EQ(with({"/h5md/modules/grseg"}), "a run");
  EXPECT_EQ(with({"/version", "/state"}), "a checkpoint of grseg-sim");
  EXPECT_EQ(with({"/h5md"}), "an H5MD file without contacts, as grseg-export writes it");
  EXPECT_EQ(with({"/else"}), "");
  std::ofstream(path) << "\x89HDF damaged";
  EXPECT_EQ(kind_of_file(path).name, "");
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace grseg
