// SPDX-License-Identifier: GPL-3.0-or-later
// Frames that a film shows, and the length of its comment.
#include "analysis/render/film.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using Frames = std::vector<std::size_t>;

TEST(FilmFrames, AreTheFirstOfEachSpan)
{
  const std::vector<double> times{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  const Frames all{0, 1, 2, 3, 4, 5, 6};
  EXPECT_EQ(film_frames(times, all, 0.25, 1e-4), (Frames{0, 3, 5}));
  EXPECT_EQ(film_frames(times, all, 0.2, 1e-4), (Frames{0, 2, 4, 6}));
  EXPECT_EQ(film_frames(times, {1, 2, 3, 4}, 0.2, 1e-4), (Frames{1, 3}));
  EXPECT_EQ(film_frames(times, all, 0, 1e-4), all);
  EXPECT_EQ(film_frames(times, all, 0.04, 1e-4), all);
}

// There are no frames from 0.2 s to 10 s. Afterwards pictures follow at the usual interval; the
// film does not show additional frames to make up for the gap.
TEST(FilmFrames, KeepTheirIntervalAfterAGap)
{
  const std::vector<double> times{0, 0.1, 0.2, 10, 10.1, 10.2, 10.3, 10.4};
  EXPECT_EQ(film_frames(times, {0, 1, 2, 3, 4, 5, 6, 7}, 0.2, 1e-4), (Frames{0, 2, 3, 5, 7}));
}

TEST(Shortened, LeavesOutTheMiddleAndNoPartOfACharacter)
{
  EXPECT_EQ(shortened("begin and end", 13), "begin and end");
  std::string text = "begin";
  for (int k = 0; k < 100; ++k) text += "\u00e9";  // two bytes
  text += "end";
  for (std::size_t most = 60; most < 70; ++most) {
    const auto short_one = shortened(text, most);
    EXPECT_LE(short_one.size(), most);
    EXPECT_TRUE(short_one.starts_with("begin\u00e9"));
    EXPECT_TRUE(short_one.ends_with("\u00e9end"));
    EXPECT_NE(short_one.find("\u00e9\n[the middle is left out]\n\u00e9"), std::string::npos);
  }
}

}  // namespace
}  // namespace grseg
