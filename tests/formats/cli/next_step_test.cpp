// SPDX-License-Identifier: GPL-3.0-or-later
// What is proposed to be run next.
#include "formats/cli/next_step.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

TEST(NextStep, QuotesWhatAShellWouldChange)
{
  EXPECT_EQ(shell_word("runs/phi0.45,a=b.h5"), "runs/phi0.45,a=b.h5");
  EXPECT_EQ(shell_word("my run.h5"), "'my run.h5'");
  EXPECT_EQ(shell_word("a;rm b"), "'a;rm b'");
  EXPECT_EQ(shell_word("Kepler's"), "'Kepler'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

// Here standard error is a pipe or a file.
TEST(NextStep, IsNotSaidWhereNobodyReads)
{
  testing::internal::CaptureStderr();
  say_next("grseg-fit stress.tsv", false);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace grseg
