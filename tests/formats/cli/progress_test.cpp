// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of work that goes on.
#include "formats/cli/progress.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

// 30 in 60 s are 0.5/s, and the 70 that are left take 140 s.
TEST(Progress, SaysTheRateAndTheTimeThatIsLeft)
{
  EXPECT_EQ(progress_text(30, 100, "frames", 60), "30 of 100 frames, 0.5/s, 2:20 left");
  EXPECT_EQ(progress_text(300, 400, "frames", 10), "300 of 400 frames, 30/s, 0:03 left");
  EXPECT_EQ(progress_text(1, 7201, "frames", 1), "1 of 7201 frames, 1.0/s, 120:00 left");
}

TEST(Progress, SaysNeitherBeforeItKnows)
{
  EXPECT_EQ(progress_text(0, 100, "windows", 5), "0 of 100 windows");
  EXPECT_EQ(progress_text(5, 100, "windows", 0), "5 of 100 windows");
}

// Here standard error is a pipe or a file, and the work is short.
TEST(Progress, OfShortWorkIsSilent)
{
  testing::internal::CaptureStderr();
  {
    ProgressBar bar("grseg-test", "things", 3, false);
    for (std::size_t k = 1; k <= 3; ++k) bar.show(k);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace grseg
