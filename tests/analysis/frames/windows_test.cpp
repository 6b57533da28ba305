// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/windows.hpp"

#include "formats/core/errors.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

/// Frames every 0.05 s, the first one at frame number `first`.
RunTimes run_of(std::int64_t frames, double step = 1e-4, std::int64_t first = 0)
{
  RunTimes run{{}, step, 0.05};
  const auto every = static_cast<std::int64_t>(0.05 / step + 0.5);
  for (std::int64_t k = 0; k < frames; ++k) run.steps.push_back((first + k) * every);
  return run;
}

// 0.05 and 1e-4 are no binary fractions: in seconds, frames would slip over the edges.
TEST(Windows, EveryWindowHoldsTheSameNumberOfFrames)
{
  for (const double step : {1e-4, 2e-4, 0.05 / 221, 0.05 / 443}) {
    const auto windows = cut_into_windows(run_of(3000, step), {});
    ASSERT_EQ(windows.size(), 120u);
    for (std::size_t n = 0; n < windows.size(); ++n) {
      EXPECT_EQ(windows[n].frames.size(), 25u);
      EXPECT_EQ(windows[n].frames.front(), 25 * n);
      EXPECT_DOUBLE_EQ(windows[n].begin, 1.25 * static_cast<double>(n));
      EXPECT_DOUBLE_EQ(windows[n].end, 1.25 * static_cast<double>(n + 1));
    }
  }
}

TEST(Windows, TheEndOfOneIsTheBeginningOfTheNext)
{
  const auto windows = cut_into_windows(run_of(3000), {.length = 0.7});
  for (std::size_t n = 1; n < windows.size(); ++n) EXPECT_EQ(windows[n].begin, windows[n - 1].end);
}

TEST(Windows, AnIncompleteLastWindowIsDropped)
{
  EXPECT_EQ(cut_into_windows(run_of(49), {}).size(), 1u);
  EXPECT_EQ(cut_into_windows(run_of(50), {}).size(), 2u);
  EXPECT_EQ(cut_into_windows(run_of(74), {}).size(), 2u);
  EXPECT_THROW(cut_into_windows(run_of(24), {}), RunError);
}

TEST(Windows, BeginAndEndCutOutAPart)
{
  const auto windows = cut_into_windows(run_of(3000), {.begin = 20, .end = 60});
  ASSERT_EQ(windows.size(), 32u);
  EXPECT_EQ(windows.front().begin, 20);
  EXPECT_EQ(windows.front().frames.front(), 400u);
  EXPECT_EQ(windows.back().end, 60);
  EXPECT_EQ(windows.back().frames.back(), 1199u);
}

TEST(Windows, TheDepositionBeforeTheTiltIsLeftOutUnlessAskedFor)
{
  const auto run = run_of(100, 1e-4, -50);
  EXPECT_EQ(cut_into_windows(run, {}).front().frames.front(), 50u);
  EXPECT_EQ(cut_into_windows(run, {.begin = -2.5}).front().frames.front(), 0u);
  EXPECT_EQ(cut_into_windows(run, {.begin = -2.5}).size(), 4u);
}

TEST(Windows, ARunThatStartsLateHasItsFirstWindowThere)
{
  const auto windows = cut_into_windows(run_of(50, 1e-4, 10), {});
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_DOUBLE_EQ(windows[0].begin, 0.5);
}

TEST(Windows, AWindowThatTheRunBeginsInsideIsDropped)
{
  const auto windows = cut_into_windows(run_of(50, 1e-4, 10), {.begin = 0});
  ASSERT_EQ(windows.size(), 1u);
  EXPECT_DOUBLE_EQ(windows[0].begin, 1.25);
  EXPECT_EQ(windows[0].frames.front(), 15u);
}

TEST(Windows, AStrideKeepsOneFrameInN)
{
  const auto windows = cut_into_windows(run_of(50), {.stride = 3});
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_EQ(windows[0].frames, (std::vector<std::size_t>{0, 3, 6, 9, 12, 15, 18, 21, 24}));
  EXPECT_EQ(windows[1].frames, (std::vector<std::size_t>{27, 30, 33, 36, 39, 42, 45, 48}));
}

TEST(Windows, ASingleFrameStandsForOneInterval)
{
  EXPECT_EQ(cut_into_windows(run_of(1), {.length = 0.05}).size(), 1u);
  EXPECT_THROW(cut_into_windows(run_of(1), {.length = 0.1}), RunError);
}

TEST(Windows, WrongUseIsRefused)
{
  EXPECT_THROW(cut_into_windows(run_of(50), {.length = 0.01}), UsageError);
  EXPECT_THROW(cut_into_windows(run_of(50), {.length = 0.05, .stride = 2}), UsageError);
  EXPECT_THROW(cut_into_windows(run_of(50), {.length = 0}), UsageError);
  EXPECT_THROW(cut_into_windows(run_of(50), {.stride = 0}), UsageError);
  EXPECT_THROW(cut_into_windows(run_of(0), {}), RunError);
  EXPECT_THROW(cut_into_windows(run_of(50), {.begin = 1000}), RunError);
}

}  // namespace
}  // namespace grseg
