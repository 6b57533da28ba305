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

/// What stands under the panels of a picture and says what they mean.

namespace grseg {

/// A part of the legend; all parts are `legend_height` em high.
struct LegendItem {
  double width;                                        // px
  std::function<void(Canvas&, const Vec2& at)> paint;  // `at`: its upper left corner, px
};
inline constexpr double legend_height = 2.7;  // em

/// A bar of a round length, `scale` px/m, no longer than `most` px; the text under it may be longer.
LegendItem scale_bar(const Canvas& canvas, double scale, double most, const Colour& ink);

/// An arrow with a g; `down` is the direction on the page, y downwards.
LegendItem gravity_arrow(const Canvas& canvas, const Vec2& down, const Colour& ink);

/// A disc in the colour of a species, its name, and over the disc the colour of its lines, where
/// there are any.
LegendItem species_key(const Canvas& canvas, const std::string& name, const Colour& grain,
                       const std::optional<Colour>& line, const Colour& ink);

/// The colours of a field under its title, with numbers; pointed where numbers lie beyond. At most
/// `most` px wide.
LegendItem colour_bar(const Canvas& canvas, const ColourScale& colours, const std::string& title,
                      double most, const Colour& ink);

/// Two lines of a round force, below `strong` N and about a quarter of that, under a title; `scale` in
/// px/N.
LegendItem force_key(const Canvas& canvas, double strong, double scale, const std::string& title,
                     const Colour& ink);

/// A sentence.
LegendItem remark(const Canvas& canvas, std::string text, const Colour& ink);

/// Where everything stands, px, y downwards.
struct Page {
  Vec2 size = Vec2::Zero();  // whole numbers
  double scale = 0;          // px/m, of all panels
  Vec2 panel_size = Vec2::Zero();
  std::vector<Vec2> panels;  // upper left corners
  std::vector<Vec2> items;   // of the legend: upper left corners
  double em = 0;
};

/// What a page must hold.
struct PageContent {
  std::size_t panels = 1;
  Vec2 panel = Vec2::Zero();  // m
  bool titles = true;         // over the panels
  /// The legend where panels have this scale (px/m), size (px) and this is the width of the page.
  std::function<std::vector<LegendItem>(double scale, const Vec2& panel, double width)> legend;
};

/// A page of this width; without one, the largest page that is neither wider nor higher than
/// `usual_page`. Panels stand in as many columns as bring the page near to 3:2 without leaving many
/// places empty, the legend stands under them in as many lines as it needs. `even`: width and height are, as films need it.
/// UsageError where the page would be higher than cairo can paint.
Page lay_out(const PageContent& content, std::optional<double> width, double em, bool even);
inline constexpr double usual_page = 1280;  // px

/// Size of letters on a page, px.
double usual_em(double width);

}  // namespace grseg
