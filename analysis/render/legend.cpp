// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/legend.hpp"

#include "analysis/render/round_numbers.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace grseg {
namespace {

// Heights in an item of the legend, em below its top: its middle, and the baselines of two lines of text.
constexpr double middle_line = 1.35, upper_line = 0.85, lower_line = 2.45;
constexpr double small_text = 0.9;
/// Distance from the middle of a line of text down to its baseline, em.
constexpr double half_letter = 0.35;

std::string force_text(double newtons)
{
  constexpr std::pair<double, const char*> units[] = {
      {1e6, "MN"}, {1e3, "kN"}, {1, "N"}, {1e-3, "mN"}, {1e-6, "µN"}};
  for (const auto& [unit, name] : units)
    if (newtons >= unit * 0.9999) return fmt::format("{:.3g} {}", newtons / unit, name);
  return fmt::format("{:.3g} N", newtons);
}

}  // namespace

LegendItem scale_bar(const Canvas& canvas, double scale, double most, const Colour& ink)
{
  const double em = canvas.em(), metres = round_below(most / scale), bar = metres * scale;
  const auto text = length_text(metres);
  const double width = std::max(bar, canvas.text_width(text));
  return {width, [=](Canvas& page, const Vec2& at) {
            const double x = at.x() + (width - bar) / 2, y = at.y() + 0.8 * em;
            const Vec2 left(x, y), right(x + bar, y), tick(0, 0.3 * em);
            const double line = em / 9;
            page.line(left, right, line, ink);
            page.line(left - tick, left + tick, line, ink);
            page.line(right - tick, right + tick, line, ink);
            page.centred_text(at + Vec2(width / 2, 2.15 * em), text, ink);
          }};
}

LegendItem gravity_arrow(const Canvas& canvas, const Vec2& down, const Colour& ink)
{
  const double em = canvas.em(), width = 2.6 * em;
  return {width, [=](Canvas& page, const Vec2& at) {
            const Vec2 centre = at + Vec2(0.9 * em, middle_line * em), side(-down.y(), down.x());
            const Vec2 tail = centre - 1.1 * em * down, tip = centre + 1.1 * em * down;
            const Vec2 neck = tip - 0.65 * em * down;
            page.line(tail, neck, em / 9, ink);
            page.polygon(
                std::array{tip, Vec2(neck + 0.28 * em * side), Vec2(neck - 0.28 * em * side)}, ink);
            page.text(at + Vec2(1.75 * em, (middle_line + half_letter) * em), "g", ink);
          }};
}

LegendItem species_key(const Canvas& canvas, const std::string& name, const Colour& grain,
                       const std::optional<Colour>& line, const Colour& ink)
{
  const double em = canvas.em(), radius = 0.48 * em, before = 1.35 * em;
  const double width = before + canvas.text_width(name);
  return {width, [=](Canvas& page, const Vec2& at) {
            const Vec2 centre = at + Vec2(radius, middle_line * em), side(radius, 0);
            page.rimmed_disc(centre, radius, grain, mix(grain, ink, 0.35), em / 18);
            if (line) page.line(centre - side, centre + side, 0.24 * em, *line);
            page.text({at.x() + before, centre.y() + half_letter * em}, name, ink);
          }};
}

LegendItem colour_bar(const Canvas& canvas, const ColourScale& colours, const std::string& title,
                      double most, const Colour& ink)
{
  const double em = canvas.em(), point = 0.6 * em, overhang = 1.2 * em;
  const double width =
      std::min(most, std::max(16 * em, canvas.text_width(title, small_text) + 2 * overhang));
  const double length = width - 2 * overhang;
  return {width, [=](Canvas& page, const Vec2& at) {
            const double top = at.y() + 1.05 * em, height = 0.6 * em, left = at.x() + overhang;
            page.centred_text(at + Vec2(width / 2, upper_line * em - 0.1 * em), title, ink,
                              small_text);
            const int steps = 256;
            for (int k = 0; k < steps; ++k) {
              // Each step is painted up to the end of the bar, so that there are no gaps between steps.
              const double from = length * k / steps;
              page.rectangle({left + from, top}, {length - from, height},
                             colours.at_place((k + 0.5) / steps));
            }
            const auto tip = [&](double x, double direction, double place) {
              page.polygon(std::array{Vec2(x, top), Vec2(x + direction * point, top + height / 2),
                                      Vec2(x, top + height)},
                           colours.at_place(place));
            };
            if (colours.below) tip(left, -1, 0);
            if (colours.above) tip(left + length, 1, 1);
            const auto at_ticks = ticks(colours.range, length > 10 * em ? 6 : 4);
            const auto labels = tick_labels(at_ticks);
            for (std::size_t k = 0; k < at_ticks.size(); ++k) {
              const double place = (at_ticks[k] - colours.range.low) / colours.range.length();
              const double x = left + length * place;
              page.line({x, top + height}, {x, top + height + 0.18 * em}, em / 14, ink);
              page.centred_text({x, at.y() + (lower_line + 0.15) * em}, labels[k], ink, small_text);
            }
          }};
}

LegendItem force_key(const Canvas& canvas, double strong, double scale, const std::string& title,
                     const Colour& ink)
{
  const double em = canvas.em(), gap = 0.4 * em, between = 1.1 * em;
  struct Mark {
    double place, length, width;  // px
    std::string text;
  };
  std::vector<Mark> keys;
  double end = 0;
  for (const double force : {round_below(strong / 4), round_below(strong)}) {
    const double width = scale * force, length = 1.6 * em + width;
    const auto text = force_text(force);
    keys.push_back({end, length, width, text});
    end += length + gap + canvas.text_width(text, small_text) + between;
  }
  const double width = std::max(end - between, canvas.text_width(title, small_text));
  return {width, [=](Canvas& page, const Vec2& at) {
            page.text(at + Vec2(0, (upper_line - 0.1) * em), title, ink, small_text);
            for (const auto& key : keys) {
              const Vec2 place = at + Vec2(key.place, (lower_line - 0.45) * em);
              page.capsule(place + Vec2(key.width / 2, 0),
                           place + Vec2(key.length - key.width / 2, 0), key.width, true, ink);
              page.text(place + Vec2(key.length + gap, half_letter * em), key.text, ink,
                        small_text);
            }
          }};
}

LegendItem remark(const Canvas& canvas, std::string text, const Colour& ink)
{
  const double em = canvas.em(), width = canvas.text_width(text);
  return {width, [=, text = std::move(text)](Canvas& page, const Vec2& at) {
            page.text(at + Vec2(0, (middle_line + half_letter) * em), text, ink);
          }};
}

namespace {

constexpr double largest_page = 32767;  // largest width or height of a page, px
// Distances on the page, em.
constexpr double margin = 0.8, gap = 1.0, title_height = 1.7, item_gap = 2.2, line_gap = 0.5,
                 legend_gap = 0.7;

/// Arranges the items in centred lines, from `top` (px) downwards, and adds their positions to `places`.
/// Returns the height of all lines, px.
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

/// The best page among all numbers of columns: its shape is near to 3:2 and few places for panels are empty.
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
  // The width is found by iteration: letters do not scale, so the height is not proportional to the width.
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
