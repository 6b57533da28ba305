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

/// The legend under the panels of a picture, and where panels and legend stand on the page.
namespace grseg {

/// A part of the legend; all parts are `legend_height` em high.
struct LegendItem {
  double width;                                        // px
  std::function<void(Canvas&, const Vec2& at)> paint;  // `at`: upper left corner of the item, px
};
inline constexpr double legend_height = 2.7;  // em

/// A bar of a round length with that length under it; `scale` in px/m. The bar is no longer than `most`
/// px, but its text may be.
LegendItem scale_bar(const Canvas& canvas, double scale, double most, const Colour& ink);

/// An arrow with the letter g; `down` is its direction on the page, y downwards.
LegendItem gravity_arrow(const Canvas& canvas, const Vec2& down, const Colour& ink);

/// A disc in the colour of a species, with its name. `line`, if given, is the colour of a bar over the
/// disc, as lines of contacts have it.
LegendItem species_key(const Canvas& canvas, const std::string& name, const Colour& grain,
                       const std::optional<Colour>& line, const Colour& ink);

/// The colours of a field under its title, with numbers. An end is pointed if numbers lie beyond it. At
/// most `most` px wide.
LegendItem colour_bar(const Canvas& canvas, const ColourScale& colours, const std::string& title,
                      double most, const Colour& ink);

/// Two lines that show the widths of two round forces, under a title: the largest below `strong` (N) and
/// below a quarter of it. `scale`: width of a line over its force, px/N.
LegendItem force_key(const Canvas& canvas, double strong, double scale, const std::string& title,
                     const Colour& ink);

/// A sentence.
LegendItem remark(const Canvas& canvas, std::string text, const Colour& ink);

/// Places of panels and legend on the page, px, y downwards.
struct Page {
  Vec2 size = Vec2::Zero();  // whole numbers
  double scale = 0;          // px/m, of all panels
  Vec2 panel_size = Vec2::Zero();
  std::vector<Vec2> panels;  // upper left corners
  std::vector<Vec2> items;   // upper left corners of the items of the legend
  double em = 0;
};

/// Panels and legend that a page must hold.
struct PageContent {
  std::size_t panels = 1;
  Vec2 panel = Vec2::Zero();  // m
  bool titles = true;         // over the panels
  /// The legend for panels of this scale (px/m) and size (px) on a page of this width (px).
  std::function<std::vector<LegendItem>(double scale, const Vec2& panel, double width)> legend;
};

/// Lays out a page of this width, px; without one, the largest page that is neither wider nor higher than
/// `usual_page`. Columns are chosen so that the page is near to 3:2 and few places are empty. The legend
/// takes as many lines under the panels as it needs. `even`: width and height are even, as films need it.
/// UsageError where the page would be higher than cairo can paint.
Page lay_out(const PageContent& content, std::optional<double> width, double em, bool even);
inline constexpr double usual_page = 1280;  // px

/// Size of letters on a page of this width, px.
double usual_em(double width);

}  // namespace grseg
