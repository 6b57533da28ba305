// SPDX-License-Identifier: GPL-3.0-or-later
// Programs that read from a pipe which this process writes.
#include "analysis/render/piped_program.hpp"

#include "tests/folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

namespace grseg {
namespace {

using PipedPrograms = TestInFolder;

std::vector<std::uint8_t> bytes_of(std::size_t count)
{
  return std::vector<std::uint8_t>(count, 'x');
}

TEST_F(PipedPrograms, GetAllBytesAndWordsThatNoShellHasSeen)
{
  const auto file = path("a b;$(c)");
  PipedProgram copy("/usr/bin/dd", {"of=" + file, "status=none"});
  EXPECT_TRUE(copy.write(bytes_of(1 << 20)));
  EXPECT_EQ(copy.finish().code, 0);
  EXPECT_EQ(content("a b;$(c)"), std::string(1 << 20, 'x'));
}

TEST_F(PipedPrograms, TellTheirExitCodeAndWhatTheySaid)
{
  PipedProgram fails("/bin/sh", {"-c", "echo no room >&2; exit 7"});
  while (fails.write(bytes_of(1 << 16))) {
  }
  const auto end = fails.finish();
  EXPECT_EQ(end.code, 7);
  EXPECT_EQ(end.said, "no room\n");
}

TEST_F(PipedPrograms, DoNotOutliveTheirOwner)
{
  const auto began = path("pid");
  pid_t process = 0;
  {
    const PipedProgram waits("/bin/sh", {"-c", "echo $$ > " + began + ".new; mv " + began +
                                                   ".new " + began + "; cat > /dev/null"});
    while (!std::filesystem::exists(began)) usleep(1000);
    process = std::atoi(content("pid").c_str());
    EXPECT_EQ(kill(process, 0), 0);
  }
  EXPECT_EQ(kill(process, 0), -1);
}

TEST_F(PipedPrograms, AreFoundInPathAndNowhereElse)
{
  const std::string path_before = std::getenv("PATH");
  put("tool", "#!/bin/sh\n");
  setenv("PATH", ("/nowhere:" + folder.string()).c_str(), 1);
  EXPECT_FALSE(find_program("tool"));  // the file is not executable
  std::filesystem::permissions(path("tool"), std::filesystem::perms::owner_all);
  EXPECT_EQ(find_program("tool"), path("tool"));
  EXPECT_FALSE(find_program("sh"));
  setenv("PATH", path_before.c_str(), 1);
}

}  // namespace
}  // namespace grseg
