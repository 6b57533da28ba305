// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/render/canvas.hpp"
#include "analysis/render/drawing.hpp"
#include "analysis/render/view.hpp"

#include <array>

namespace grseg {

/// Where a point of the picture's plane (m) lies on the page (px).
class Projection {
 public:
  /// The middle of `region` comes to `centre`; `angle` (rad) turns everything counter-clockwise.
  Projection(const Region& region, const Vec2& centre, double scale, double angle);

  Vec2 operator()(const Vec2& point) const { return centre_ + direction(point - middle_); }
  /// The same of a vector.
  Vec2 direction(const Vec2& vector) const;
  double scale() const { return scale_; }

 private:
  Vec2 middle_, centre_;
  double scale_, cos_, sin_;
};

/// Width and height (m) of what a region covers when it is turned by `angle`.
Vec2 turned_size(const Region& region, double angle);

/// Paints one panel: walls, grains, contacts, nothing outside of the region; the ends of a period
/// are dashed. `balls`: grains are spheres.
void paint_panel(Canvas& canvas, const Drawing& drawing, const View& view,
                 const Projection& to_page, const Theme& theme, bool balls);

}  // namespace grseg
