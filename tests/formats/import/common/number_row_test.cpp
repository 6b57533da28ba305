// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/text_values.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

TEST(Number, IsReadAsCAndFortranWriteIt)
{
  const std::pair<const char*, double> words[] = {{"1", 1},
                                                  {"+.5", 0.5},
                                                  {"-2.5e-3", -2.5e-3},
                                                  {"1.0D-05", 1e-5},
                                                  {"-1.25d+2", -125},
                                                  {"1D2", 100},
                                                  {"3.Q0", 3},
                                                  {"1.0-105", 1e-105},
                                                  {"2.5+101", 2.5e101},
                                                  {"-1.0-308", -1e-308}};
  for (const auto& [word, value] : words) {
    double number = 0;
    EXPECT_TRUE(read_number(word, number)) << word;
    EXPECT_DOUBLE_EQ(number, value) << word;
  }
}

TEST(Number, ThatIsTooSmallToBeHeldIsZero)
{
  for (const char* word : {"1e-400", "1.0D-400", "-1.0-999"}) {
    double number = 1;
    EXPECT_TRUE(read_number(word, number)) << word;
    EXPECT_EQ(number, 0) << word;
  }
}

TEST(Number, IsNotAWordADateARangeOrWhatIsNotFinite)
{
  double number = 0;
  for (const char* word :
       {"",        "+",     "+-1",        "D5",      "1D",         "1.0D", "1.0-10",
        "1-105-2", "5-10",  "2020-01-02", "1e5D3",   "1e5-105",    "nan",  "NaND3",
        "inf",     "1e999", "1.0D999",    "1.0+999", "**********", "1,5",  "0x1"})
    EXPECT_FALSE(read_number(word, number)) << word;
}

}  // namespace
}  // namespace grseg
