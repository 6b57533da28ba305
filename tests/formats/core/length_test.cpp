// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/length.hpp"

#include "formats/core/errors.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

constexpr LengthUnits paper{0.005, 0.01};

TEST(Length, IsInMetresUnlessAUnitSaysOtherwise)
{
  EXPECT_DOUBLE_EQ(parse_length("0.02", "layer", paper), 0.02);
  EXPECT_DOUBLE_EQ(parse_length("20mm", "layer", paper), 0.02);
  EXPECT_DOUBLE_EQ(parse_length("2cm", "layer", paper), 0.02);
  EXPECT_DOUBLE_EQ(parse_length("4dS", "layer", paper), 0.02);
  EXPECT_DOUBLE_EQ(parse_length("35dL", "length", paper), 0.35);
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
