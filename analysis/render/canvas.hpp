// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/render/colours.hpp"
#include "formats/core/frame.hpp"

#include <cairo.h>

#include <memory>
#include <span>
#include <string>

namespace grseg {

struct CairoSurfaceDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, CairoSurfaceDeleter>;

/// Paints on a cairo surface. Positions and lengths are in pixels, y points down the page.
class Canvas {
 public:
  /// `em`: size of the letters, px. `quick` is for films: circles have fewer corners and edges are
  /// smoothed with fewer shades.
  Canvas(cairo_surface_t* surface, double em, bool quick = false);

  double em() const { return em_; }

  void fill_all(const Colour& colour);
  void disc(const Vec2& centre, double radius, const Colour& colour);
  /// A disc with a rim, which lies inside the radius; `rim` is the width of the rim, px.
  void rimmed_disc(const Vec2& centre, double radius, const Colour& colour,
                   const Colour& rim_colour, double rim);
  /// A sphere, lit from the upper left.
  void ball(const Vec2& centre, double radius, const Colour& colour);
  /// A line with a round start; its end is round, too, if `round_end` is true.
  void capsule(const Vec2& from, const Vec2& to, double width, bool round_end,
               const Colour& colour);
  void line(const Vec2& from, const Vec2& to, double width, const Colour& colour);
  void dashed_line(const Vec2& from, const Vec2& to, double width, const Colour& colour);
  void polygon(std::span<const Vec2> corners, const Colour& colour);
  void rectangle(const Vec2& low, const Vec2& size, const Colour& colour);

  /// Restricts painting to the polygon until end_clip() is called.
  void clip(std::span<const Vec2> corners);
  void end_clip();

  /// One line of text. `at` is the left end of its baseline, or the middle of the baseline for
  /// centred_text(). `size` is in em, the returned width in px.
  void text(const Vec2& at, const std::string& text, const Colour& colour, double size = 1);
  void centred_text(const Vec2& at, const std::string& text, const Colour& colour, double size = 1);
  double text_width(const std::string& text, double size = 1) const;

 private:
  struct Deleter {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  void set(const Colour& colour);
  void path(std::span<const Vec2> corners);

  std::unique_ptr<cairo_t, Deleter> cairo_;
  double em_;
  bool quick_;
};

}  // namespace grseg
