// SPDX-License-Identifier: GPL-3.0-or-later
// Messages about the progress of work.
#include "formats/cli/progress.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

namespace grseg {
namespace {

// 30 items in 60 s are 0.5/s, and the remaining 70 take 140 s.
TEST(Progress, StatesTheRateAndTheRemainingTime)
{
  EXPECT_EQ(progress_text(30, {"frames", 100}, 60), "30 of 100 frames, 0.50/s, 2:20 left");
  EXPECT_EQ(progress_text(300, {"frames", 400}, 10), "300 of 400 frames, 30/s, 0:03 left");
  EXPECT_EQ(progress_text(1, {"frames", 7201}, 1), "1 of 7201 frames, 1.0/s, 120:00 left");
}

// From 10 s on, 5 s of flow take 20 s: the rate is a quarter, and 135 s take nine minutes.
TEST(Progress, OfARunThatIsContinuedHasTheRateOfWhatIsNew)
{
  const Work flow{"s of flow", 150, 10, 2};
  EXPECT_EQ(progress_text(15, flow, 20), "15.00 of 150.00 s of flow, 0.25/s, 9:00 left");
  EXPECT_EQ(progress_text(10, flow, 20), "10.00 of 150.00 s of flow");
}

TEST(Progress, StatesNoRemainingTimeIfTheTotalIsUnknown)
{
  EXPECT_EQ(progress_text(30, {"frames"}, 10), "30 frames, 3.0/s");
}

// A bed was expected to rest after 0.3 s, and still moves.
TEST(Progress, BeyondAnEstimatedTotalStatesNoTimeLeft)
{
  const Work deposition{"s of deposition", 0.3, 0, 2};
  EXPECT_EQ(progress_text(0.45, deposition, 3), "0.45 s of deposition, 0.15/s");
}

TEST(Progress, SaysNeitherRateNorTimeBeforeTheyAreKnown)
{
  EXPECT_EQ(progress_text(0, {"windows", 100}, 5), "0 of 100 windows");
  EXPECT_EQ(progress_text(5, {"windows", 100}, 0), "5 of 100 windows");
}

// In this test, standard error is a pipe or a file, and the work is short.
TEST(Progress, IsNotShownForShortWork)
{
  testing::internal::CaptureStderr();
  {
    ProgressBar bar("grseg-test", {"things", 3}, false);
    bar.say("beginning");
    for (int k = 1; k <= 3; ++k) bar.show(k);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// As if the terminal of a run has been closed.
TEST(Tell, AClosedStandardErrorIsNoReasonToStop)
{
  const int kept = dup(STDERR_FILENO);
  close(STDERR_FILENO);
  EXPECT_NO_THROW(tell("nobody reads this\n"));
  dup2(kept, STDERR_FILENO);
  close(kept);
}

// In this test, standard error is a pipe or a file.
TEST(NextStep, IsNotPrintedIfStandardErrorIsNoTerminal)
{
  testing::internal::CaptureStderr();
  say_next("grseg-fit stress.tsv", false);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace grseg
