// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/output_lock.hpp"

#include "formats/core/errors.hpp"
#include "tests/folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <optional>

namespace grseg {
namespace {

int no_locks(int)
{
  return EOPNOTSUPP;
}

std::string host()
{
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// Test parameter: true if the file system supports locks.
class OneWriter : public TestInFolder, public testing::WithParamInterface<bool> {
 protected:
  std::string run = path("run.h5");
  int (*lock)(int) = GetParam() ? lock_file : no_locks;

  std::string complaint() const
  {
    return complaint_of<UsageError>([&] { const OutputLock another(run, lock); });
  }
  /// Starts a process that takes the lock and is killed.
  void leave_a_dead_lock() const
  {
    const pid_t child = fork();
    if (child == 0) {
      const OutputLock its(run, lock);
      raise(SIGKILL);
    }
    waitpid(child, nullptr, 0);
  }
};

INSTANTIATE_TEST_SUITE_P(WithAndWithoutLocks, OneWriter, testing::Bool());

TEST_P(OneWriter, ASecondOneIsRefusedAndToldWhoHasIt)
{
  const OutputLock first(run, lock);
  const auto who = fmt::format("process {} on {}", getpid(), host());
  EXPECT_EQ(complaint(),
            run + " is being written by " + who +
                (GetParam() ? "; wait for it, or choose another name"
                            : ", says " + run + ".lock; if that run is dead, remove this file"));
}

TEST_P(OneWriter, TheLockGoesWithItsOwner)
{
  std::optional<OutputLock> first;
  first.emplace(run, lock);
  EXPECT_EQ(names(), std::set<std::string>{"run.h5.lock"});
  first.reset();
  EXPECT_EQ(names(), std::set<std::string>{});
  EXPECT_EQ(complaint(), "no complaint");
}

TEST_P(OneWriter, ARefusedOneLeavesTheLock)
{
  const OutputLock first(run, lock);
  complaint();
  EXPECT_NE(complaint(), "no complaint");
}

TEST_P(OneWriter, AKilledOneBlocksNobody)
{
  leave_a_dead_lock();
  EXPECT_EQ(names(), std::set<std::string>{"run.h5.lock"});
  EXPECT_EQ(complaint(), "no complaint");
  EXPECT_EQ(names(), std::set<std::string>{});
}

TEST_P(OneWriter, AnotherOutputIsFree)
{
  const OutputLock first(run, lock);
  EXPECT_NO_THROW(OutputLock(path("other.h5"), lock));
}

TEST_P(OneWriter, AFolderThatIsMissingIsNamed)
{
  EXPECT_EQ(complaint_of<RunError>([&] { OutputLock(path("nowhere/run.h5"), lock); }),
            "cannot create " + path("nowhere/run.h5.lock") + ": No such file or directory");
}

TEST_P(OneWriter, OfManyThatFindADeadLockOneGetsIt)
{
  for (int round = 0; round < 20; ++round) {
    leave_a_dead_lock();
    std::array<int, 2> finish{};
    ASSERT_EQ(pipe(finish.data()), 0);
    std::array<pid_t, 8> children{};
    for (auto& child : children) {
      child = fork();
      if (child != 0) continue;
      close(finish[1]);
      alarm(60);  // otherwise two owners would wait for each other
      try {
        const OutputLock its(run, lock);
        char end = 0;
        _exit(read(finish[0], &end, 1) == 0 ? 0 : 1);  // keeps the lock until all have tried
      } catch (const UsageError&) {
        _exit(2);
      }
    }
    int refused = 0, status = 0;
    for (; refused < 7; ++refused) {
      ASSERT_GT(wait(&status), 0);
      ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 2);
    }
    close(finish[1]);
    close(finish[0]);
    ASSERT_GT(wait(&status), 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    std::filesystem::remove(run + ".lock");
  }
}

class LockFile : public TestInFolder {
 protected:
  std::string complaint(const std::string& owner) const
  {
    put("run.h5.lock", owner);
    return complaint_of<UsageError>([&] { OutputLock(path("run.h5"), no_locks); });
  }
};

TEST_F(LockFile, OfAnotherComputerIsNotTakenOver)
{
  EXPECT_EQ(complaint("elsewhere 42 7\n"),
            path("run.h5") + " is being written by process 42 on elsewhere, says " +
                path("run.h5.lock") + "; if that run is dead, remove this file");
  EXPECT_EQ(content("run.h5.lock"), "elsewhere 42 7\n");
}

TEST_F(LockFile, OfAnotherProcessThatHadThisNumberIsTakenOver)
{
  EXPECT_EQ(complaint(fmt::format("{} {} 1\n", host(), getpid())), "no complaint");
}

TEST_F(LockFile, OfADeadProcessThatAnotherLooksAtIsLeftToThatOne)
{
  put("run.h5.lock.claim", "");
  const auto dead = fmt::format("{} {} 1\n", host(), getpid());
  EXPECT_EQ(complaint(dead),
            path("run.h5") + " is being written by a process that it does not name, says " +
                path("run.h5.lock.claim") + "; if that run is dead, remove this file");
  EXPECT_EQ(content("run.h5.lock"), dead);
}

TEST_F(LockFile, ThatNamesNobodyIsNotTakenOver)
{
  EXPECT_EQ(complaint(""), path("run.h5") +
                               " is being written by a process that it does not name, says " +
                               path("run.h5.lock") + "; if that run is dead, remove this file");
}

}  // namespace
}  // namespace grseg
