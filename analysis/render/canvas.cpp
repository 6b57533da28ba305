// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/canvas.hpp"

#include <sys/auxv.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

namespace grseg {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr const char* font = "DejaVu Sans";

/// Makes cairo use the fonts that came with the program (scripts/portable), if any, since the system may
/// have no fonts. Returns true. Call it once, to initialise a static: several threads make canvases, but
/// setenv must not run in two threads at once.
bool use_own_fonts()
{
  std::error_code none;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): getauxval(3) returns an address as a number
  const auto* name = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  const auto program = std::filesystem::canonical(name, none);
  const auto own = program.parent_path().parent_path() / "share/grseg/fonts.conf";
  if (std::filesystem::exists(own, none)) setenv("FONTCONFIG_FILE", own.c_str(), 0);
  return true;
}

/// Sets how text is drawn, so that the user's desktop settings do not change the bytes of a picture.
void fix_font_options(cairo_t* cairo)
{
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(cairo, options);
  cairo_font_options_destroy(options);
}

}  // namespace

Canvas::Canvas(cairo_surface_t* surface, double em, bool quick)
    : cairo_(cairo_create(surface)), em_(em), quick_(quick)
{
  // Largest error of a curve, px; small in still pictures, because SVG and PDF may be magnified.
  cairo_set_tolerance(cairo_.get(), quick ? 0.25 : 0.02);
  if (quick) cairo_set_antialias(cairo_.get(), CAIRO_ANTIALIAS_FAST);
  [[maybe_unused]] static const bool chosen = use_own_fonts();
  fix_font_options(cairo_.get());
  cairo_select_font_face(cairo_.get(), font, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
}

void Canvas::set(const Colour& colour)
{
  cairo_set_source_rgb(cairo_.get(), colour.red, colour.green, colour.blue);
}

void Canvas::path(std::span<const Vec2> corners)
{
  cairo_new_path(cairo_.get());
  for (const auto& corner : corners) cairo_line_to(cairo_.get(), corner.x(), corner.y());
  cairo_close_path(cairo_.get());
}

void Canvas::fill_all(const Colour& colour)
{
  set(colour);
  cairo_paint(cairo_.get());
}

void Canvas::disc(const Vec2& centre, double radius, const Colour& colour)
{
  set(colour);
  cairo_new_path(cairo_.get());
  cairo_arc(cairo_.get(), centre.x(), centre.y(), radius, 0, full_turn);
  cairo_fill(cairo_.get());
}

void Canvas::rimmed_disc(const Vec2& centre, double radius, const Colour& colour,
                         const Colour& rim_colour, double rim)
{
  if (quick_) {  // two filled discs take half the time of a stroke
    disc(centre, radius, rim_colour);
    disc(centre, radius - rim, colour);
    return;
  }
  cairo_new_path(cairo_.get());
  cairo_arc(cairo_.get(), centre.x(), centre.y(), radius - rim / 2, 0, full_turn);
  set(colour);
  cairo_fill_preserve(cairo_.get());
  set(rim_colour);
  cairo_set_line_width(cairo_.get(), rim);
  cairo_stroke(cairo_.get());
}

void Canvas::ball(const Vec2& centre, double radius, const Colour& colour)
{
  const Vec2 light = centre - Vec2::Constant(0.35 * radius);
  cairo_pattern_t* shade =
      cairo_pattern_create_radial(light.x(), light.y(), 0, centre.x(), centre.y(), radius);
  const auto stop = [&](double place, const Colour& c) {
    cairo_pattern_add_color_stop_rgb(shade, place, c.red, c.green, c.blue);
  };
  stop(0, mix(colour, {1, 1, 1}, 0.45));
  stop(0.5, colour);
  stop(1, mix(colour, {0, 0, 0}, 0.45));
  cairo_set_source(cairo_.get(), shade);
  cairo_pattern_destroy(shade);
  cairo_new_path(cairo_.get());
  cairo_arc(cairo_.get(), centre.x(), centre.y(), radius, 0, full_turn);
  cairo_fill(cairo_.get());
}

void Canvas::capsule(const Vec2& from, const Vec2& to, double width, bool round_end,
                     const Colour& colour)
{
  const Vec2 along = to - from;
  const double angle = std::atan2(along.y(), along.x()), quarter = full_turn / 4;
  cairo_new_path(cairo_.get());
  cairo_arc(cairo_.get(), from.x(), from.y(), width / 2, angle + quarter, angle + 3 * quarter);
  if (round_end) {
    cairo_arc(cairo_.get(), to.x(), to.y(), width / 2, angle - quarter, angle + quarter);
  } else {
    const Vec2 side = width / 2 * Vec2(std::sin(angle), -std::cos(angle));
    cairo_line_to(cairo_.get(), to.x() + side.x(), to.y() + side.y());
    cairo_line_to(cairo_.get(), to.x() - side.x(), to.y() - side.y());
  }
  cairo_close_path(cairo_.get());
  set(colour);
  cairo_fill(cairo_.get());
}

void Canvas::line(const Vec2& from, const Vec2& to, double width, const Colour& colour)
{
  set(colour);
  cairo_new_path(cairo_.get());
  cairo_move_to(cairo_.get(), from.x(), from.y());
  cairo_line_to(cairo_.get(), to.x(), to.y());
  cairo_set_line_width(cairo_.get(), width);
  cairo_stroke(cairo_.get());
}

void Canvas::dashed_line(const Vec2& from, const Vec2& to, double width, const Colour& colour)
{
  const double dash = 0.4 * em_;
  cairo_set_dash(cairo_.get(), &dash, 1, 0);
  line(from, to, width, colour);
  cairo_set_dash(cairo_.get(), nullptr, 0, 0);
}

void Canvas::polygon(std::span<const Vec2> corners, const Colour& colour)
{
  path(corners);
  set(colour);
  cairo_fill(cairo_.get());
}

void Canvas::rectangle(const Vec2& low, const Vec2& size, const Colour& colour)
{
  set(colour);
  cairo_new_path(cairo_.get());
  cairo_rectangle(cairo_.get(), low.x(), low.y(), size.x(), size.y());
  cairo_fill(cairo_.get());
}

void Canvas::clip(std::span<const Vec2> corners)
{
  cairo_save(cairo_.get());
  path(corners);
  cairo_clip(cairo_.get());
}

void Canvas::end_clip()
{
  cairo_restore(cairo_.get());
}

void Canvas::text(const Vec2& at, const std::string& text, const Colour& colour, double size)
{
  set(colour);
  cairo_set_font_size(cairo_.get(), size * em_);
  cairo_move_to(cairo_.get(), at.x(), at.y());
  cairo_show_text(cairo_.get(), text.c_str());
}

void Canvas::centred_text(const Vec2& at, const std::string& text, const Colour& colour,
                          double size)
{
  this->text(at - Vec2(text_width(text, size) / 2, 0), text, colour, size);
}

double Canvas::text_width(const std::string& text, double size) const
{
  cairo_text_extents_t extents;
  cairo_set_font_size(cairo_.get(), size * em_);
  cairo_text_extents(cairo_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

}  // namespace grseg
