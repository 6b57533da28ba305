// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/render/canvas.hpp"
#include "analysis/render/drawing.hpp"
#include "analysis/render/view.hpp"

#include <array>

namespace grseg {

/// Maps points of the picture's plane (m) to the page (px, y downwards).
class Projection {
 public:
  /// Maps the middle of `region` (m) to `centre` (px); `scale` in px/m; `angle` (rad) turns
  /// counter-clockwise.
  Projection(const Region& region, const Vec2& centre, double scale, double angle);

  Vec2 operator()(const Vec2& point) const { return centre_ + direction(point - middle_); }
  /// Maps a vector, which is turned and scaled but not shifted.
  Vec2 direction(const Vec2& vector) const;
  double scale() const { return scale_; }

 private:
  Vec2 middle_, centre_;
  double scale_, cos_, sin_;
};

/// Width and height (m) of the smallest upright rectangle around a region turned by `angle` (rad).
Vec2 turned_size(const Region& region, double angle);

/// Paints walls, grains and contacts of one panel, cut off at the edge of the region. Dashed lines mark the
/// ends of periods. `balls`: grains are painted as spheres.
void paint_panel(Canvas& canvas, const Drawing& drawing, const View& view,
                 const Projection& to_page, const Theme& theme, bool balls);

}  // namespace grseg
