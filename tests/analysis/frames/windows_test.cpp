// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/windows.hpp"

#include "formats/core/errors.hpp"

#include <gtest/gtest.h>

#include <string>

namespace grseg {
namespace {

/// A run with a frame every 0.05 s; the first one has the frame number `first`.
RunTimes run_of(std::int64_t frames, double step = 1e-4, std::int64_t first = 0)
{
  RunTimes run{{}, step, 0.05};
  const auto every = static_cast<std::int64_t>(0.05 / step + 0.5);
  for (std::int64_t k = 0; k < frames; ++k) run.steps.push_back((first + k) * every);
  return run;
}

// 0.05 and 1e-4 are not binary fractions: if times were compared in seconds, frames would fall into
// wrong windows.
TEST(Windows, EveryWindowHoldsTheSameNumberOfFrames)
{
  for (const double step : {1e-4, 2e-4, 0.05 / 221, 0.05 / 443}) {
    const auto windows = cut_into_windows(run_of(3000, step), {}).list;
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
  const auto windows = cut_into_windows(run_of(3000), {.length = 0.7}).list;
  for (std::size_t n = 1; n < windows.size(); ++n) EXPECT_EQ(windows[n].begin, windows[n - 1].end);
}

TEST(Windows, AnIncompleteLastWindowIsDropped)
{
  EXPECT_EQ(cut_into_windows(run_of(49), {}).list.size(), 1u);
  EXPECT_EQ(cut_into_windows(run_of(50), {}).list.size(), 2u);
  EXPECT_EQ(cut_into_windows(run_of(74), {}).list.size(), 2u);
  EXPECT_THROW(cut_into_windows(run_of(24), {}), RunError);
}

TEST(Windows, BeginAndEndCutOutAPart)
{
  const auto windows = cut_into_windows(run_of(3000), {.begin = 20, .end = 60}).list;
  ASSERT_EQ(windows.size(), 32u);
  EXPECT_EQ(windows.front().begin, 20);
  EXPECT_EQ(windows.front().frames.front(), 400u);
  EXPECT_EQ(windows.back().end, 60);
  EXPECT_EQ(windows.back().frames.back(), 1199u);
}

TEST(Windows, TheDepositionBeforeTheTiltIsLeftOutUnlessAskedFor)
{
  const auto run = run_of(100, 1e-4, -50);
  EXPECT_EQ(cut_into_windows(run, {}).list.front().frames.front(), 50u);
  EXPECT_EQ(cut_into_windows(run, {.begin = -2.5}).list.front().frames.front(), 0u);
  EXPECT_EQ(cut_into_windows(run, {.begin = -2.5}).list.size(), 4u);
}

TEST(Windows, ARunThatStartsLateHasItsFirstWindowThere)
{
  const auto windows = cut_into_windows(run_of(50, 1e-4, 10), {}).list;
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_DOUBLE_EQ(windows[0].begin, 0.5);
}

TEST(Windows, AWindowThatTheRunBeginsInsideIsDropped)
{
  const auto windows = cut_into_windows(run_of(50, 1e-4, 10), {.begin = 0}).list;
  ASSERT_EQ(windows.size(), 1u);
  EXPECT_DOUBLE_EQ(windows[0].begin, 1.25);
  EXPECT_EQ(windows[0].frames.front(), 15u);
}

TEST(Windows, AStrideKeepsOneFrameInN)
{
  const auto windows = cut_into_windows(run_of(50), {.stride = 3}).list;
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_EQ(windows[0].frames, (std::vector<std::size_t>{0, 3, 6, 9, 12, 15, 18, 21, 24}));
  EXPECT_EQ(windows[1].frames, (std::vector<std::size_t>{27, 30, 33, 36, 39, 42, 45, 48}));
}

TEST(Windows, ASingleFrameStandsForOneInterval)
{
  EXPECT_EQ(cut_into_windows(run_of(1), {.length = 0.05}).list.size(), 1u);
  EXPECT_THROW(cut_into_windows(run_of(1), {.length = 0.1}), RunError);
}

/// Frames at these step numbers, steps of 1 ms; the scene does not state the frame interval.
RunTimes run_at(std::vector<std::int64_t> steps)
{
  return {std::move(steps), 1e-3, 0};
}

std::vector<std::int64_t> every(std::int64_t by, std::int64_t begin, std::int64_t end)
{
  std::vector<std::int64_t> steps;
  for (auto step = begin; step < end; step += by) steps.push_back(step);
  return steps;
}

std::vector<double> begins(const RunTimes& run, double length)
{
  std::vector<double> begins;
  for (const auto& window : cut_into_windows(run, {.length = length}).list)
    begins.push_back(window.begin);
  return begins;
}

// 2 s long: every 0.1 s three frames in consecutive steps.
TEST(Windows, BurstsStandForTheTimeToTheNextBurst)
{
  std::vector<std::int64_t> steps;
  for (const auto begin : every(100, 0, 2000))
    for (const int k : {0, 1, 2}) steps.push_back(begin + k);
  auto run = run_at(steps);
  for (const double interval : {0.0, 0.1}) {
    run.frame_interval = interval;
    EXPECT_EQ(longest_interval(run), 98);
    EXPECT_EQ(begins(run, 0.5), (std::vector{0.0, 0.5, 1.0, 1.5}));
    EXPECT_EQ(begins(run, 2), std::vector{0.0});
    EXPECT_EQ(cut_into_windows(run, {.length = 0.5}).list[0].frames.size(), 15u);
    EXPECT_THROW(cut_into_windows(run, {.length = 0.02}), UsageError);
  }
}

TEST(Windows, TwoBurstsStandForTheIntervalOfTheScene)
{
  auto run = run_at({0, 1, 2, 100, 101, 102});
  run.frame_interval = 0.1;
  EXPECT_EQ(begins(run, 0.1), (std::vector{0.0, 0.1}));
}

// A frame every 0.05 s, then every 0.01 s, and one a second later, which represents 0.05 s.
TEST(Windows, AFrameBehindAHoleFillsNoWindow)
{
  auto steps = every(50, 0, 500);
  for (const auto step : every(10, 500, 601)) steps.push_back(step);
  steps.push_back(1600);
  const auto run = run_at(steps);
  EXPECT_EQ(longest_interval(run), 50);
  const auto windows = begins(run, 0.2);
  ASSERT_EQ(windows.size(), 3u);
  EXPECT_DOUBLE_EQ(windows[2], 0.4);
  EXPECT_THROW(cut_into_windows(run, {.length = 1}), RunError);
}

TEST(Windows, AnExtraFrameAtTheEndTakesNoWindowAway)
{
  auto steps = every(50, 0, 1000);
  steps.push_back(955);
  EXPECT_EQ(begins(run_at(steps), 0.2).size(), 5u);
}

// A frame every 0.01 s for 10 s; 30 frames are missing.
TEST(Windows, MayHaveAHoleOfATenth)
{
  auto steps = every(10, 0, 3000);
  for (const auto step : every(10, 3300, 10000)) steps.push_back(step);
  EXPECT_EQ(begins(run_at(steps), 1).size(), 9u);
  EXPECT_EQ(begins(run_at(steps), 5).size(), 2u);
}

TEST(Windows, AllIsOneWindowOverTheFramesUsed)
{
  const auto all = cut_into_windows(run_of(50), {.length = all_frames});
  ASSERT_EQ(all.list.size(), 1u);
  EXPECT_EQ(all.list[0].frames.size(), 50u);
  EXPECT_EQ(all.list[0].begin, 0);
  EXPECT_DOUBLE_EQ(all.list[0].end, 2.5);
  EXPECT_EQ(all.length, all.list[0].end);
  const auto part = cut_into_windows(run_of(50), {all_frames, 0.5, 1.5, 2});
  ASSERT_EQ(part.list.size(), 1u);
  EXPECT_EQ(part.list[0].frames,
            (std::vector<std::size_t>{10, 12, 14, 16, 18, 20, 22, 24, 26, 28}));
  EXPECT_EQ(cut_into_windows(run_of(1), {.length = all_frames}).list.size(), 1u);
  // The run begins at 0.5 s: it has no frame before.
  EXPECT_DOUBLE_EQ(cut_into_windows(run_of(50, 1e-4, 10), {all_frames, 0.0}).list[0].begin, 0.5);
}

// 0.1, 0.2 and 0.4 are not binary fractions, and 2.2 - 2 is not 0.2.
TEST(Windows, TheirLengthIsTheOneThatWasGiven)
{
  for (const double length : {0.1, 0.2, 0.4, 0.7})
    EXPECT_EQ(cut_into_windows(run_of(50), {length, 0.3}).length, length);
  EXPECT_DOUBLE_EQ(cut_into_windows(run_of(50), {.length = 0.60004}).length, 0.6);  // whole steps
}

std::string sentence_of(const RunTimes& run, const WindowSettings& settings)
{
  try {
    cut_into_windows(run, settings);
  } catch (const ToolError& error) {
    return error.what();
  }
  return "";
}

TEST(Windows, AMessageProposesALengthThatFits)
{
  EXPECT_EQ(sentence_of(run_of(10), {}),
            "no window of 1.25 s is filled by frames between 0 s and 0.5 s; choose --window 0.5 "
            "or --window all");
  EXPECT_EQ(sentence_of(run_of(10), {.length = 0.04}),
            "--window 0.04 s is shorter than the 0.05 s between the frames used; choose --window "
            "0.05 or longer, or --window all");
  EXPECT_EQ(sentence_of(run_of(10, 1e-4, 10), {.begin = 0}),
            "no window of 1.25 s is filled by frames between 0 s and 1 s; choose --window all, "
            "or another --begin and --end");
  EXPECT_EQ(sentence_of(run_of(10), {.begin = 2}),
            "no frame lies between --begin and --end; the run has frames from 0 s to 0.45 s");
}

// Three steps of 0.1234567 s are neither 0.37 s nor 0.3704 s; the length that the message proposes
// is accepted.
TEST(Windows, TheLengthThatAMessageProposesIsAccepted)
{
  RunTimes run{{0, 1, 2}, 0.1234567, 0};
  const auto sentence = sentence_of(run, {});
  const auto at = sentence.find("--window ");
  ASSERT_NE(at, std::string::npos);
  const auto length = std::stod(sentence.substr(at + 9));
  EXPECT_EQ(cut_into_windows(run, {.length = length}).list.size(), 1u);
}

TEST(Windows, WrongUseIsRefused)
{
  EXPECT_THROW(cut_into_windows(run_of(50), {.length = 0.01}), UsageError);
  EXPECT_THROW(cut_into_windows(run_of(50), {.length = 0.05, .stride = 2}), UsageError);
  EXPECT_THROW(cut_into_windows(run_of(50), {.length = 0}), UsageError);
  EXPECT_THROW(cut_into_windows(run_of(50), {.stride = 0}), UsageError);
  EXPECT_THROW(cut_into_windows(run_of(0), {}), RunError);
  EXPECT_THROW(cut_into_windows(run_of(50), {.begin = 1000}), RunError);
  EXPECT_THROW(cut_into_windows(run_of(50), {.length = all_frames, .begin = 1000}), RunError);
}

}  // namespace
}  // namespace grseg
