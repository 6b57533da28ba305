// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/words.hpp"

#include "formats/core/errors.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

enum class Colour { red, green, blue };
constexpr Choice<Colour> colours[] = {
    {"red", Colour::red}, {"blue", Colour::blue, "as the sky"}, {"green", Colour::green}};

TEST(Choice, AWordStandsForItsValueAndBack)
{
  for (const auto& colour : colours) {
    EXPECT_EQ(choose(colour.word, "--colour", colours), colour.value);
    EXPECT_STREQ(word_of(colour.value, colours), colour.word);
  }
}

TEST(Choice, AnUnknownWordIsAnsweredWithAllThatAreKnown)
{
  try {
    choose("pink", "--colour", colours);
    ADD_FAILURE() << "pink was taken";
  } catch (const UsageError& error) {
    const std::string sentence = error.what();
    for (const char* part : {"--colour", "pink", "red", "blue", "green"})
      EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  }
}

TEST(Choice, TheListForHelpSaysWhatAWordMeans)
{
  EXPECT_EQ(list_of(colours), "red, blue (as the sky) or green");
}

}  // namespace
}  // namespace grseg
