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

/// Content of a page of two runs, of which the second has a B.
Json two_runs()
{
  const Json rules{{{"name", "half"}, {"B", {-0.3, -0.4, -0.2}}, {"doubt", ""}},
                   {{"name", "size"}, {"B", {-0.0128, -0.0372, 0.0127}}, {"doubt", "of <size>"}}};
  const Json fit{{"verdict", {"flows", "steady"}},
                 {"doubts", {"of all"}},
                 {"rules", rules},
                 {"over", "windows"},
                 {"over_words", "these"}};
  return {{"program", "grseg-explore 1"},
          {"start", "size"},
          {"runs", {{{"name", "a"}}, {{"name", "<b>"}, {"fit", fit}}}}};
}

TEST(Page, ShowsBWithItsVerdictAndDoubtsBeforeItsScriptHasRun)
{
  const auto page = page_of(two_runs(), {});
  const auto html = page.substr(0, page.find("<script"));
  for (const auto* text : {"<title>a, &lt;b&gt; \u2013 grseg</title>", ">B by size<",
                           ">\u22120.013<", ">[\u22120.037, 0.013] (95 %)<",
                           "<li>flows.</li><li>steady.</li>", ">95 % over windows: these.<",
                           "<li>of all.</li><li>of &lt;size&gt;.</li>", "Made by grseg-explore 1;"})
    EXPECT_EQ(count(html, text), 1u) << text;
}

TEST(Page, HasADashForBOnlyWhereThereIsNone)
{
  auto content = two_runs();
  content["runs"][1].erase("fit");
  const auto page = page_of(content, {});
  EXPECT_EQ(count(page.substr(0, page.find("<script")), ">\u2013<"), 1u);
}

TEST(Page, HoldsTheContentAndTheArraysOfEachRunOnce)
{
  const auto page = page_of(two_runs(), {"QUJD", "REVG"});
  EXPECT_EQ(
      count(page, R"(<script type="application/json" id="content">{"program":"grseg-explore 1")"),
      1u);
  EXPECT_EQ(count(page, R"(<script type="text/plain" id="arrays-0">QUJD</script>)"), 1u);
  EXPECT_EQ(count(page, R"(<script type="text/plain" id="arrays-1">REVG</script>)"), 1u);
  EXPECT_EQ(count(page, "{{"), 0u) << "no mark is left";
}

TEST(Page, LoadsNothingAndRunsOneScript)
{
  const auto page = page_of(two_runs(), {});
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
  const auto page = page_of(two_runs(), {});
  EXPECT_NE(page.find("Mike Bostock. Licence ISC"), std::string::npos);
  EXPECT_NE(page.find("Licence BSD-3-Clause"), std::string::npos);
}

}  // namespace
}  // namespace grseg
