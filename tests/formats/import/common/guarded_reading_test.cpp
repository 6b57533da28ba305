// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/guarded_reading.hpp"

#include "formats/core/errors.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <ctime>
#include <functional>
#include <vector>

namespace grseg {
namespace {

/// Reads the file "run.hdf5", which does not exist, in a child, as grseg-import does.
[[noreturn]] void import(const std::function<void()>& read)
{
  continue_in_child("grseg-import", "");
  try {
    read_guarded("run.hdf5", "run.hdf5, t = 2", read);
  } catch (const ToolError& error) {
    std::fprintf(stderr, "%s", error.what());
    _exit(error.code());
  }
  _exit(0);
}

void use_processor(double seconds)
{
  const auto end = std::clock() + static_cast<std::clock_t>(seconds * CLOCKS_PER_SEC);
  while (std::clock() < end) {
  }
}

TEST(GuardedReading, EndsAsTheChildDoes)
{
  const testing::ExitedWithCode done(0), refused(2), damaged(3);
  EXPECT_EXIT(import([] {}), done, "");
  EXPECT_EXIT(import([] { throw UsageError("no such file"); }), refused, "^no such file$");
  EXPECT_EXIT(import([] { throw FormatError("row 3"); }), damaged, "^row 3$");
}

TEST(GuardedReading, ACrashBecomesASentence)
{
  EXPECT_EXIT(import([] {
                std::signal(SIGSEGV, SIG_DFL);
                std::raise(SIGSEGV);
              }),
              testing::ExitedWithCode(3),
              "^grseg-import: run.hdf5, t = 2: reading ends in a crash .signal 11.; the file is "
              "damaged: copy it again\n$");
}

TEST(GuardedReading, ACrashOutsideBlamesNoFile)
{
  EXPECT_EXIT(
      {
        continue_in_child("grseg-import", "");
        read_guarded("run.hdf5", "run.hdf5", [] {});
        std::signal(SIGABRT, SIG_DFL);
        std::raise(SIGABRT);
      },
      testing::KilledBySignal(SIGABRT), "^$");
}

TEST(GuardedReading, WorkWithoutAnEndIsStopped)
{
  EXPECT_EXIT(import([] { use_processor(60); }), testing::ExitedWithCode(3),
              "run.hdf5, t = 2: reading does not end; the file is damaged: copy it again");
}

TEST(GuardedReading, MayTakeItsTimeForEachFrameAndOtherWorkAnyTime)
{
  EXPECT_EXIT(
      {
        continue_in_child("grseg-import", "");
        for (int k = 0; k < 3; ++k)
          read_guarded("run.hdf5", "run.hdf5", [] { use_processor(0.6); });
        use_processor(1.5);
        _exit(0);
      },
      testing::ExitedWithCode(0), "");
}

TEST(GuardedReading, HasLimitedMemory)
{
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer reserves any memory itself";
#endif
  EXPECT_EXIT(import([] { const std::vector<char> much(std::size_t{4} << 30); }),
              testing::ExitedWithCode(3),
              "^run.hdf5: reading asks for more memory than a file of this size can fill");
}

TEST(GuardedReading, ASignalForTheParentReachesTheChild)
{
  EXPECT_EXIT(
      {
        continue_in_child("grseg-import", "");
        std::signal(SIGTERM, [](int) { _exit(143); });
        kill(getppid(), SIGTERM);
        use_processor(60);
      },
      testing::ExitedWithCode(143), "");
}

}  // namespace
}  // namespace grseg
