// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/text.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

TEST(Text, ThatCanBePrintedIsLeftAsItIs)
{
  for (const char* text : {"", "run 1.h5", "\\x0a", "\xcf\x86_L = 0.30, 23\xc2\xb0", "\xe2\x82\xac",
                           "\xf0\x9f\x98\x80"})
    EXPECT_EQ(printable(text), text);
}

TEST(Text, ControlCharactersAreShownAndDoNothing)
{
  EXPECT_EQ(printable("a\nb\tc\r"), "a\\x0ab\\x09c\\x0d");
  EXPECT_EQ(printable("\x1b[2J\x7f"), "\\x1b[2J\\x7f");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xc2\x9b\x31m"), "\\xc2\\x9b1m");  // U+009B also begins an escape sequence
}

TEST(Text, BytesThatAreNoCharacterAreShown)
{
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xc3"), "\\xc3");                    // an incomplete character
  EXPECT_EQ(printable("\x80z"), "\\x80z");                  // no first byte
  EXPECT_EQ(printable("\xc0\x8a"), "\\xc0\\x8a");           // a newline in an overlong encoding
  EXPECT_EQ(printable("\xe0\x80\x8a"), "\\xe0\\x80\\x8a");  // another overlong encoding
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // half of a surrogate pair of UTF-16
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond the last character
}

TEST(Text, OfSeveralLinesKeepsThem)
{
  EXPECT_EQ(printable_lines("one\n\x1btwo\n"), "one\n\\x1btwo\n");
  EXPECT_EQ(printable_lines("one"), "one");
}

TEST(Text, ThatIsQuotedIsCutWhereItIsLong)
{
  EXPECT_EQ(excerpt("short\n"), "short\\x0a");
  const std::string word(1000, 'x');
  EXPECT_EQ(excerpt(word), word.substr(0, 60).append("..."));
}

TEST(Xml, TextStandsBetweenTagsAndQuotes)
{
  EXPECT_EQ(xml_escaped("<a b=\"c\"> & d"), "&lt;a b=&quot;c&quot;&gt; &amp; d");
  EXPECT_EQ(xml_escaped("φ_L"), "φ_L");
}

}  // namespace
}  // namespace grseg
