// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/painter.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// Smallest radius of a grain that is painted with a rim, px; the rim would cover a smaller grain.
constexpr double least_rimmed = 2.5;

void paint_grain(Canvas& canvas, const Vec2& centre, double radius, const Colour& colour,
                 const Theme& theme, bool is_ball)
{
  if (radius < least_rimmed)
    canvas.disc(centre, radius, colour);
  else if (is_ball)
    canvas.ball(centre, radius, colour);
  else
    canvas.rimmed_disc(centre, radius, colour, mix(colour, theme.ink, 0.35),
                       std::clamp(0.1 * radius, 0.4, 1.5));
}

void paint_wall(Canvas& canvas, const WallLine& wall, const Region& region,
                const Projection& to_page, const Theme& theme)
{
  // The wall is a line from far beyond one side of the region to far beyond the opposite side.
  const Vec2 middle = (region.low + region.high) / 2;
  const Vec2 foot = middle - (middle - wall.point).dot(wall.normal) * wall.normal;
  const Vec2 along = region.size().norm() * Vec2(-wall.normal.y(), wall.normal.x());
  const Vec2 from = to_page(foot - along), to = to_page(foot + along);
  const Vec2 behind = -0.5 * canvas.em() * to_page.direction(wall.normal).normalized();
  canvas.polygon(std::array<Vec2, 4>{from, to, to + behind, from + behind}, theme.boundary);
  canvas.line(from, to, canvas.em() / 9, theme.ink);
}

/// Paints dashed lines at the ends of periods that lie in the region.
void paint_periods(Canvas& canvas, const View& view, const Projection& to_page, const Theme& theme)
{
  const auto& region = view.region;
  for (int axis = 0; axis < 2; ++axis) {
    const double period = view.period(axis);
    if (!(period > 0)) continue;
    constexpr double round_off = 1e-9;
    const double first = std::ceil(region.low[axis] / period - round_off);
    for (double k = first; k * period <= region.high[axis] + round_off * period; ++k) {
      Vec2 from = region.low, to = region.high;
      from[axis] = to[axis] = k * period;
      canvas.dashed_line(to_page(from), to_page(to), canvas.em() / 9, theme.faint);
    }
  }
}

}  // namespace

Projection::Projection(const Region& region, const Vec2& centre, double scale, double angle)
    : middle_((region.low + region.high) / 2),
      centre_(centre),
      scale_(scale),
      cos_(std::cos(angle)),
      sin_(std::sin(angle))
{
}

Vec2 Projection::direction(const Vec2& vector) const
{
  return {scale_ * (cos_ * vector.x() - sin_ * vector.y()),
          -scale_ * (sin_ * vector.x() + cos_ * vector.y())};
}

Vec2 turned_size(const Region& region, double angle)
{
  const double cos = std::abs(std::cos(angle)), sin = std::abs(std::sin(angle));
  const Vec2 size = region.size();
  return {cos * size.x() + sin * size.y(), sin * size.x() + cos * size.y()};
}

void paint_panel(Canvas& canvas, const Drawing& drawing, const View& view,
                 const Projection& to_page, const Theme& theme, bool balls)
{
  const auto& [low, high] = view.region;
  canvas.clip(std::array{to_page(low), to_page({high.x(), low.y()}), to_page(high),
                         to_page({low.x(), high.y()})});
  for (const auto& wall : drawing.walls) paint_wall(canvas, wall, view.region, to_page, theme);
  for (const auto& disc : drawing.discs)
    paint_grain(canvas, to_page(disc.centre), to_page.scale() * disc.radius, disc.colour, theme,
                balls);
  for (const auto& line : drawing.lines)
    canvas.capsule(to_page(line.from), to_page(line.to), to_page.scale() * line.width,
                   line.round_end, line.colour);
  canvas.end_clip();
  paint_periods(canvas, view, to_page, theme);
}

}  // namespace grseg
