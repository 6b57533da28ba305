// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/page.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

constexpr double largest_page = 32767;  // px
// em
constexpr double margin = 0.8, gap = 1.0, title_height = 1.7, item_gap = 2.2, line_gap = 0.5,
                 legend_gap = 0.7;

/// Places the items in lines, each line in the middle of the page; the height that they need.
double place_legend(const std::vector<LegendItem>& items, double width, double em, double top,
                    std::vector<Vec2>& places)
{
  const double room = width - 2 * margin * em;
  double y = top;
  for (std::size_t begin = 0; begin < items.size();) {
    double line = items[begin].width;
    std::size_t end = begin + 1;
    while (end < items.size() && line + item_gap * em + items[end].width <= room)
      line += item_gap * em + items[end++].width;
    double x = (width - line) / 2;
    for (; begin < end; ++begin) {
      places.emplace_back(x, y);
      x += items[begin].width + item_gap * em;
    }
    y += (legend_height + line_gap) * em;
  }
  return items.empty() ? 0 : y - line_gap * em - top;
}

Page page_of(const PageContent& content, double width, std::size_t columns, double em)
{
  Page page;
  page.em = em;
  const auto across = static_cast<double>(columns);
  const std::size_t rows = (content.panels + columns - 1) / columns;
  const double title = content.titles ? title_height * em : 0;
  const double panel_width = (width - 2 * margin * em - (across - 1) * gap * em) / across;
  page.scale = panel_width / content.panel.x();
  page.panel_size = page.scale * content.panel;
  for (std::size_t k = 0; k < content.panels; ++k) {
    const std::size_t column = k % columns, row = k / columns;
    page.panels.emplace_back(
        margin * em + static_cast<double>(column) * (panel_width + gap * em),
        margin * em + title + static_cast<double>(row) * (page.panel_size.y() + title + gap * em));
  }
  const double bottom =
      margin * em - gap * em + static_cast<double>(rows) * (title + page.panel_size.y() + gap * em);
  const auto items = content.legend(page.scale, page.panel_size, width);
  const double legend = place_legend(items, width, em, bottom + legend_gap * em, page.items);
  const double height = bottom + (items.empty() ? 0 : legend_gap * em + legend) + margin * em;
  page.size = {std::ceil(width), std::ceil(height)};
  return page;
}

/// The page whose shape is nearest to 3:2; empty places count against it.
Page best_page(const PageContent& content, double width, double em)
{
  Page best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t columns = 1; columns <= content.panels; ++columns) {
    auto page = page_of(content, width, columns, em);
    const auto empty = static_cast<double>((columns - content.panels % columns) % columns);
    const double off = std::abs(std::log(page.size.x() / page.size.y() / 1.5)) +
                       empty / static_cast<double>(content.panels);
    if (!(page.panel_size.x() > 0) || off >= least) continue;
    least = off;
    best = std::move(page);
  }
  if (!(least < std::numeric_limits<double>::infinity()))
    throw UsageError(
        "the picture is too narrow for its height; choose another --width or --region");
  return best;
}

}  // namespace

double usual_em(double width)
{
  return std::clamp(0.0145 * width, 11.0, 60.0);
}

Page lay_out(const PageContent& content, std::optional<double> width, double em, bool even)
{
  auto page = best_page(content, width.value_or(usual_page), em);
  // Letters keep their size, so that the height is not in proportion to the width.
  for (int k = 0; k < 20 && !width && page.size.y() > usual_page; ++k)
    page = best_page(content, page.size.x() * std::min(0.99, usual_page / page.size.y()), em);
  if (even) page.size = (page.size / 2).array().ceil() * 2;
  if (page.size.maxCoeff() > largest_page)
    throw UsageError(fmt::format(
        "the picture would be {:.0f} x {:.0f} pixels; choose a smaller --width or another "
        "--region",
        page.size.x(), page.size.y()));
  return page;
}

}  // namespace grseg
