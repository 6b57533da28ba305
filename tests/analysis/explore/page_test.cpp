// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/page.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

std::size_t count(const std::string& text, const std::string& word)
{
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST(Page, NoTextOfAFileCanEndItsElement)
{
  const Json content{{"name", "</script><script>alert(1)</script>"}, {"<!--", "<!--"}};
  const auto json = json_for_page(content);
  EXPECT_EQ(json.find('<'), std::string::npos);
  EXPECT_EQ(Json::parse(json), content);
}

TEST(Page, WhatIsNotUtf8IsReplaced)
{
  EXPECT_EQ(Json::parse(json_for_page(Json{{"name", "\xff\xfe"}}))["name"], "\ufffd\ufffd");
}

TEST(Page, HoldsTheContentAndTheArraysOfEachRunOnce)
{
  const auto page = page_of({{"name", "run"}}, {"QUJD", "REVG"});
  EXPECT_EQ(count(page, R"(<script type="application/json" id="content">{"name":"run"}</script>)"),
            1u);
  EXPECT_EQ(count(page, R"(<script type="text/plain" id="arrays-0">QUJD</script>)"), 1u);
  EXPECT_EQ(count(page, R"(<script type="text/plain" id="arrays-1">REVG</script>)"), 1u);
  EXPECT_EQ(count(page, "{{"), 0u) << "no mark is left";
}

TEST(Page, LoadsNothingAndRunsOneScript)
{
  const auto page = page_of(Json::object(), {});
  EXPECT_EQ(count(page, "<script>"), 1u);
  EXPECT_EQ(count(page, "default-src 'none'"), 1u);
  EXPECT_EQ(count(page, "script-src 'sha256-"), 1u);
  EXPECT_EQ(count(page, "style-src 'sha256-"), 1u);
  EXPECT_EQ(count(page, "src="), 0u);
  EXPECT_EQ(count(page, "import("), 0u);
  EXPECT_EQ(count(page, "fetch("), 0u);
}

TEST(Page, HoldsTheLicencesOfWhatItBorrows)
{
  const auto page = page_of(Json::object(), {});
  EXPECT_NE(page.find("Mike Bostock. Licence ISC"), std::string::npos);
  EXPECT_NE(page.find("Licence BSD-3-Clause"), std::string::npos);
}

}  // namespace
}  // namespace grseg
