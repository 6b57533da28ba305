// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/binary_arrays.hpp"

#include "tests/analysis/explore/unpacked.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace grseg {
namespace {

TEST(BinaryArrays, NumbersOfAllKindsComeBackAsTheyWere)
{
  BinaryArrays arrays;
  const std::vector<std::uint8_t> bytes{0, 1, 255};
  const std::vector<std::uint16_t> codes{0, 258, 65535};
  const std::vector<std::uint32_t> rows{4294967295u, 16909060u};
  const std::vector<float> reals{0.1f, -3e8f};
  const std::vector<double> doubles{1.0 / 3, -0.0, std::numeric_limits<double>::denorm_min()};
  arrays.add("a", bytes);
  arrays.add("c", codes);
  arrays.add("d", rows);
  arrays.add("e", reals);
  arrays.add("f", doubles);
  arrays.add("nothing", std::vector<double>{});
  EXPECT_EQ(unpacked::array<std::uint8_t>(arrays, "a", "u8"), bytes);
  EXPECT_EQ(unpacked::array<std::uint16_t>(arrays, "c", "u16"), codes);
  EXPECT_EQ(unpacked::array<std::uint32_t>(arrays, "d", "u32"), rows);
  EXPECT_EQ(unpacked::array<float>(arrays, "e", "f32"), reals);
  EXPECT_EQ(unpacked::array<double>(arrays, "f", "f64"), doubles);
  EXPECT_EQ(unpacked::array<double>(arrays, "nothing", "f64").size(), 0u);
}

TEST(BinaryArrays, TheDirectoryNamesThemInTheOrderInWhichTheyCame)
{
  BinaryArrays arrays;
  arrays.add("z", std::vector<std::uint16_t>{1, 2, 3});
  arrays.add("a", std::vector<double>{1});
  EXPECT_EQ(
      arrays.directory().dump(),
      R"({"z":{"type":"u16","offset":0,"length":3},"a":{"type":"f64","offset":6,"length":1}})");
}

TEST(BinaryArrays, TextsOfAllLengthsAreWholeBase64)
{
  for (std::size_t n = 0; n < 9; ++n) {
    BinaryArrays arrays;
    std::vector<std::uint8_t> numbers;
    for (std::size_t k = 0; k < n; ++k) numbers.push_back(static_cast<std::uint8_t>(37 * k + 11));
    arrays.add("x", numbers);
    EXPECT_EQ(arrays.base64().size() % 4, 0u) << n;
    EXPECT_EQ(unpacked::array<std::uint8_t>(arrays, "x", "u8"), numbers);
  }
}

}  // namespace
}  // namespace grseg
