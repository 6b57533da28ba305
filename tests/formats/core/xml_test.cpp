// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/xml.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

TEST(Xml, TextStandsBetweenTagsAndQuotes)
{
  EXPECT_EQ(xml_escaped("<a b=\"c\"> & d"), "&lt;a b=&quot;c&quot;&gt; &amp; d");
  EXPECT_EQ(xml_escaped("φ_L"), "φ_L");
}

}  // namespace
}  // namespace grseg
