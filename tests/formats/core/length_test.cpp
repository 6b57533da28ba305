// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/length.hpp"

#include "formats/core/errors.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

constexpr LengthUnits paper{0.005, 0.01};

TEST(Length, HasAUnit)
{
  EXPECT_DOUBLE_EQ(parse_length("0.02m", "layer", paper), 0.02);
  EXPECT_DOUBLE_EQ(parse_length("0", "layer", paper), 0);
  EXPECT_DOUBLE_EQ(parse_length("20mm", "layer", paper), 0.02);
  EXPECT_DOUBLE_EQ(parse_length("2cm", "layer", paper), 0.02);
  EXPECT_DOUBLE_EQ(parse_length("4dS", "layer", paper), 0.02);
  EXPECT_DOUBLE_EQ(parse_length("35dL", "length", paper), 0.35);
}

std::string refusal(const std::string& text, LengthUnits units)
{
  try {
    parse_length(text, "--layer", units);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(Length, WithoutAUnitIsRefusedWithWhatItMayMean)
{
  EXPECT_EQ(refusal("4", paper), "--layer 4 has no unit: 4dS, 4dL or 4m?");
  EXPECT_EQ(refusal("4e-2", {}), "--layer 4e-2 has no unit: 4e-2m or 4e-2mm?");
  EXPECT_EQ(parse_length("0", "--layer", paper), 0);
}

TEST(Length, WithoutKnownDiametersHasNoDiameterUnits)
{
  EXPECT_THROW(parse_length("4dS", "layer", {}), UsageError);
}

TEST(Length, ThatIsNotALengthIsRefusedByName)
{
  for (const auto* text : {"", "dS", "4 dS", "4feet", "nan", "inf", "1e999"}) {
    try {
      parse_length(text, "layer", paper);
      FAIL() << text;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("layer"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace grseg
