// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/render/canvas.hpp"
#include "analysis/render/drawing.hpp"
#include "formats/core/frame.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Legend under the panels of a picture, and the positions of panels and legend on the page.
namespace grseg {

/// One item of the legend, e.g. a scale bar. All items are `legend_height` em high.
struct LegendItem {
  double width;                                        // width of the item, px
  std::function<void(Canvas&, const Vec2& at)> paint;  // `at`: upper left corner of the item, px
};
inline constexpr double legend_height = 2.7;  // height of the legend's items, em

/// A bar of a round length with the length as text under it; `scale` in px/m. The bar is at most `most` px
/// long; the text may be longer.
LegendItem scale_bar(const Canvas& canvas, double scale, double most, const Colour& ink);

/// An arrow with the letter g; `down` is the arrow's direction on the page, y downwards.
LegendItem gravity_arrow(const Canvas& canvas, const Vec2& down, const Colour& ink);

/// A disc in the colour of a species, with the species' name. `line`, if given, is the colour of the lines
/// of contacts for this species; a bar in this colour crosses the disc.
LegendItem species_key(const Canvas& canvas, const std::string& name, const Colour& grain,
                       const std::optional<Colour>& line, const Colour& ink);

/// Colour bar of a field with numbers, under its title. An end of the bar is pointed if values lie beyond
/// it. The item is at most `most` px wide.
LegendItem colour_bar(const Canvas& canvas, const ColourScale& colours, const std::string& title,
                      double most, const Colour& ink);

/// Two lines that show the widths of two round forces, under a title: the largest round force below
/// `strong` (N), and the largest one below a quarter of `strong`. `scale`: line width per force, px/N.
LegendItem force_key(const Canvas& canvas, double strong, double scale, const std::string& title,
                     const Colour& ink);

/// A line of text.
LegendItem remark(const Canvas& canvas, std::string text, const Colour& ink);

/// Positions of panels and legend on the page, px, y downwards.
struct Page {
  Vec2 size = Vec2::Zero();  // width and height of the page, px; whole numbers
  double scale = 0;          // scale of all panels, px/m
  Vec2 panel_size = Vec2::Zero();
  std::vector<Vec2> panels;  // upper left corners of the panels
  std::vector<Vec2> items;   // upper left corners of the items of the legend
  double em = 0;             // size of letters, px
};

/// Panels and legend that must fit on a page.
struct PageContent {
  std::size_t panels = 1;
  Vec2 panel = Vec2::Zero();  // width and height of the region that a panel shows, m
  bool titles = true;         // true if panels have titles
  /// Makes the legend for panels of this scale (px/m) and size (px) on a page of this width (px).
  std::function<std::vector<LegendItem>(double scale, const Vec2& panel, double width)> legend;
};

/// Lays out a page of width `width`, px; without a width, the largest page that is neither wider nor higher
/// than `usual_page`. The number of columns is chosen so that the shape is near to 3:2 and few places for
/// panels stay empty. The legend has as many lines under the panels as it needs. `even`: width and height
/// become even, as films require. Throws UsageError if the page would be larger than cairo can paint.
Page lay_out(const PageContent& content, std::optional<double> width, double em, bool even);
inline constexpr double usual_page = 1280;  // largest width and height by default, px

/// Default size of letters, px, on a page of this width, px.
double usual_em(double width);

}  // namespace grseg
