// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/memory.hpp"

#include "tests/folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

namespace grseg {
namespace {

/// A machine with 8 kB of free memory, whose files lie in the folder of the test.
class FreeMemory : public TestInFolder {
 protected:
  void SetUp() override
  {
    TestInFolder::SetUp();
    in("proc/meminfo", "MemTotal: 16 kB\nMemAvailable: 8 kB\n");
  }
  void in(const std::string& name, const std::string& text) const
  {
    std::filesystem::create_directories((folder / name).parent_path());
    put(name, text);
  }
  double bytes() const { return free_memory(folder.string()); }
};

TEST_F(FreeMemory, IsThatOfTheMachineWhereNoGroupHasALimit)
{
  EXPECT_EQ(bytes(), 8192);
  in("proc/self/cgroup", "0::/job/step\n");
  in("sys/fs/cgroup/job/memory.max", "max\n");
  in("sys/fs/cgroup/job/memory.current", "4096\n");
  EXPECT_EQ(bytes(), 8192);
  EXPECT_EQ(free_memory(path("nowhere")), std::numeric_limits<double>::infinity());
}

TEST_F(FreeMemory, IsWhatTheNarrowestGroupLeaves)
{
  in("proc/self/cgroup", "0::/job/step\n");
  in("sys/fs/cgroup/job/step/memory.max", "5000\n");
  in("sys/fs/cgroup/job/step/memory.current", "1000\n");
  EXPECT_EQ(bytes(), 4000);
  in("sys/fs/cgroup/job/memory.max", "4500\n");  // the group above it
  in("sys/fs/cgroup/job/memory.current", "3000\n");
  EXPECT_EQ(bytes(), 1500);
  in("sys/fs/cgroup/job/memory.stat", "anon 2000\ninactive_file 1000\n");  // cached files
  EXPECT_EQ(bytes(), 2500);
  in("sys/fs/cgroup/memory.max", "100\n");  // the mount of a container
  EXPECT_EQ(bytes(), 100);
}

TEST_F(FreeMemory, IsLimitedByGroupsOfVersionOneToo)
{
  in("proc/self/cgroup", "9:cpu,cpuacct:/job\n4:memory:/docker/7\n0::/\n");
  in("sys/fs/cgroup/memory/memory.limit_in_bytes", "3000\n");
  in("sys/fs/cgroup/memory/memory.usage_in_bytes", "2500\n");
  EXPECT_EQ(bytes(), 500);
  in("sys/fs/cgroup/memory/docker/7/memory.limit_in_bytes", "300\n");
  in("sys/fs/cgroup/memory/docker/7/memory.usage_in_bytes", "900\n");
  EXPECT_EQ(bytes(), 0);
}

}  // namespace
}  // namespace grseg
