// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of a page, the legend, and the bytes of a file.
#include "analysis/render/legend.hpp"
#include "analysis/render/picture_file.hpp"
#include "analysis/render/picture_options.hpp"
#include "formats/core/errors.hpp"
#include "tests/folder.hpp"

#include <gtest/gtest.h>

namespace grseg {
namespace {

/// Content with panels of width 2 m and height 1 m, and legend items of these widths, px.
PageContent content_of(std::size_t panels, const std::vector<double>& items)
{
  PageContent content;
  content.panels = panels;
  content.panel = {2, 1};
  content.legend = [items](double, const Vec2&, double) {
    std::vector<LegendItem> all;
    all.reserve(items.size());
    for (const double width : items) all.push_back({width, [](Canvas&, const Vec2&) {}});
    return all;
  };
  return content;
}

TEST(Page, ThePanelFillsTheWidthBetweenItsMargins)
{
  const auto page = lay_out(content_of(1, {}), 1000, 10, false);
  EXPECT_EQ(page.size.x(), 1000);
  EXPECT_DOUBLE_EQ(page.panels[0].x(), 8);
  EXPECT_DOUBLE_EQ(page.panel_size.x(), 984);
  EXPECT_DOUBLE_EQ(page.panel_size.y(), 492);
  EXPECT_DOUBLE_EQ(page.scale, 492);
}

TEST(Page, NothingOverlapsAndAllLiesOnThePage)
{
  for (const std::size_t panels : {1u, 2u, 3u, 7u}) {
    const auto page = lay_out(content_of(panels, {300, 200, 400, 100}), 800, 12, false);
    ASSERT_EQ(page.panels.size(), panels);
    double bottom = 0;
    for (std::size_t a = 0; a < panels; ++a) {
      const Vec2 end = page.panels[a] + page.panel_size;
      EXPECT_TRUE((page.panels[a].array() >= 0).all() && (end.array() <= page.size.array()).all());
      bottom = std::max(bottom, end.y());
      for (std::size_t b = 0; b < a; ++b) {
        const Vec2 apart = (page.panels[a] - page.panels[b]).cwiseAbs() - page.panel_size;
        EXPECT_GT(apart.maxCoeff(), 0);
      }
    }
    for (const auto& item : page.items) {
      EXPECT_GT(item.y(), bottom);
      EXPECT_LE(item.y() + legend_height * 12, page.size.y());
    }
  }
}

// A line has 800 - 2 x 0.8 x 12 = 780.8 px: 300, a gap of 2.2 x 12 and 200 fit; an item of 400 does not.
TEST(Page, TheLegendContinuesInAnotherLineIfOneIsFull)
{
  const auto page = lay_out(content_of(1, {300, 200, 400, 100}), 800, 12, false);
  ASSERT_EQ(page.items.size(), 4u);
  EXPECT_EQ(page.items[0].y(), page.items[1].y());
  EXPECT_GT(page.items[2].y(), page.items[1].y() + legend_height * 12);
  EXPECT_EQ(page.items[3].y(), page.items[2].y());
  EXPECT_NEAR(page.items[1].x() - page.items[0].x(), 300 + 2.2 * 12, 1e-9);
}

TEST(Page, TallPanelsStandSideBySideAndWideOnesBelowEachOther)
{
  auto content = content_of(2, {});
  const auto wide = lay_out(content, 800, 12, false);
  EXPECT_EQ(wide.panels[0].x(), wide.panels[1].x());
  content.panel = {1, 1};
  const auto tall = lay_out(content, 800, 12, false);
  EXPECT_EQ(tall.panels[0].y(), tall.panels[1].y());
}

TEST(Page, FourSquarePanelsAreTwoByTwo)
{
  auto content = content_of(4, {});
  content.panel = {1, 1};
  const auto page = lay_out(content, 800, 12, false);
  EXPECT_EQ(page.panels[1].y(), page.panels[0].y());
  EXPECT_EQ(page.panels[2].x(), page.panels[0].x());
  EXPECT_EQ(page.panels[3].x(), page.panels[1].x());
}

TEST(Page, WithoutAWidthATallPictureIsNoHigherThanUsual)
{
  auto content = content_of(1, {100});
  content.panel = {1, 5};
  const auto page = lay_out(content, std::nullopt, 18, false);
  EXPECT_LE(page.size.y(), usual_page);
  EXPECT_GT(page.size.y(), 0.9 * usual_page);
  EXPECT_EQ(lay_out(content_of(1, {}), std::nullopt, 18, false).size.x(), usual_page);
}

TEST(Page, FilmsHaveEvenSides)
{
  for (const double width : {640.0, 641.0, 643.0}) {
    const auto page = lay_out(content_of(1, {}), width, 12, true);
    EXPECT_EQ(std::fmod(page.size.x(), 2), 0);
    EXPECT_EQ(std::fmod(page.size.y(), 2), 0);
  }
}

TEST(Page, WhatCairoCannotPaintIsRefused)
{
  auto content = content_of(1, {});
  content.panel = {1, 1000};
  EXPECT_NE(complaint_of<UsageError>([&] {
              lay_out(content, 1000, 12, false);
            }).find("choose a smaller --width or another --region"),
            std::string::npos);
}

TEST(Legend, TheScaleBarIsTheLongestRoundLengthThatFits)
{
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, 400, 100));
  Canvas canvas(surface.get(), 10);
  canvas.fill_all(rgb(0xffffff));
  // 1000 px/m and 270 px: 20 cm, 200 px.
  const auto item = scale_bar(canvas, 1000, 270, rgb(0x000000));
  EXPECT_NEAR(item.width, 200, 1e-9);
  item.paint(canvas, {50, 0});
  cairo_surface_flush(surface.get());
  const unsigned char* const row = cairo_image_surface_get_data(surface.get()) + 8 * 1600;
  int dark = 0;
  for (int x = 0; x < 400; ++x) dark += row[4 * x] < 128 ? 1 : 0;
  EXPECT_NEAR(dark, 200, 2);
}

TEST(PageWidth, IsInPixelsOrOnPaper)
{
  EXPECT_FALSE(parse_width("").pixels);
  EXPECT_EQ(*parse_width("640").pixels, 640);
  EXPECT_EQ(*parse_width("25.4mm").pixels, 300);
  EXPECT_EQ(*parse_width("2.54cm").pixels, 300);
  EXPECT_EQ(*parse_width("2in").pixels, 600);
  // 8 points of 1/72 inch, with 300 pixels per inch.
  EXPECT_NEAR(parse_width("2in").em * parse_width("2in").points, 8, 1e-12);
  EXPECT_NEAR(600 * parse_width("2in").points, 144, 1e-12);
  EXPECT_EQ(complaint_of<UsageError>([] { parse_width("3"); }),
            "--width 3: that is 3 pixels; choose 64 to 20000");
  EXPECT_EQ(
      complaint_of<UsageError>([] { parse_width("wide"); }),
      "--width 'wide': write a number of pixels, or a width on paper as 86mm, 8.6cm or 3.4in");
}

TEST(PictureFile, TheEndOfTheNameSaysWhatItIs)
{
  EXPECT_EQ(picture_kind("a.b/c.svg"), PictureKind::svg);
  EXPECT_TRUE(is_film(picture_kind("film.webm")));
  for (const char* name : {"picture", "picture.jpg", ".png", "-"})
    EXPECT_NE(complaint_of<UsageError>([&] { picture_kind(name); }), "no complaint") << name;
}

TEST(PictureFile, ThePixelsAreThoseThatWerePainted)
{
  const Pixels pixels({3, 2}, [](cairo_surface_t* surface) {
    Canvas canvas(surface, 10);
    canvas.fill_all(rgb(0x102030));
    canvas.rectangle({1, 1}, {1, 1}, rgb(0xff8000));
  });
  const auto bytes = pixels.bytes();
  ASSERT_EQ(bytes.size(), 24u);
  EXPECT_EQ(bytes[0], 0x30);
  EXPECT_EQ(bytes[2], 0x10);
  EXPECT_EQ(bytes[12 + 4 + 0], 0x00);
  EXPECT_EQ(bytes[12 + 4 + 1], 0x80);
  EXPECT_EQ(bytes[12 + 4 + 2], 0xff);
}

TEST(PictureFile, HistoriesAreEscapedInXml)
{
  const auto svg = picture_bytes(PictureKind::svg, {10, 10}, 1, "a < b & \"c\" -->", [](auto*) {});
  EXPECT_NE(svg.find("<desc>a &lt; b &amp; &quot;c&quot; --&gt;</desc>"), std::string::npos);
}

}  // namespace
}  // namespace grseg
