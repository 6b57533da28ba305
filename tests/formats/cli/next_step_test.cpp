// SPDX-License-Identifier: GPL-3.0-or-later
// What is proposed to be run next.
#include "formats/cli/next_step.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

// Here standard error is a pipe or a file.
TEST(NextStep, IsNotSaidWhereNobodyReads)
{
  testing::internal::CaptureStderr();
  say_next("grseg-fit stress.tsv", false);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace grseg
