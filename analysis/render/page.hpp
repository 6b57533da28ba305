// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/render/legend.hpp"
#include "formats/core/frame.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace grseg {

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
