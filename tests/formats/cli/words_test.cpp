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

// cohesion becomes rotation by replacing four of its eight letters, and --stress becomes --stride by
// replacing three of six.
TEST(NearestWord, DiffersInAThirdOfItsLettersAtMost)
{
  const std::vector<std::string> known{"--rotation", "--friction", "--stride", "--layer"};
  EXPECT_EQ(nearest("--cohesion", known), "");
  EXPECT_EQ(nearest("--stress", known), "");
  EXPECT_EQ(nearest("--lay", known), "");
  EXPECT_EQ(nearest("--a", known), "");
  EXPECT_EQ(nearest("--", known), "");
  EXPECT_EQ(nearest("--layr", known), "--layer");
  EXPECT_EQ(nearest("--rotaton", known), "--rotation");
  EXPECT_EQ(nearest("--frictoin", known), "--friction");
  EXPECT_EQ(nearest("frction", {"friction"}), "friction");
}

TEST(Choice, TheListForHelpSaysWhatAWordMeans)
{
  EXPECT_EQ(list_of(colours), "red, blue (as the sky) or green");
}

}  // namespace
}  // namespace grseg
