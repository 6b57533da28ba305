// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/render/canvas.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/frame.hpp"

#include <cairo.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace grseg {

/// What a file is, by the end of its name.
enum class PictureKind { png, svg, pdf, mp4, webm };
inline constexpr Choice<PictureKind> picture_kinds[] = {{"png", PictureKind::png},
                                                        {"svg", PictureKind::svg},
                                                        {"pdf", PictureKind::pdf},
                                                        {"mp4", PictureKind::mp4},
                                                        {"webm", PictureKind::webm}};
inline bool is_film(PictureKind kind)
{
  return kind == PictureKind::mp4 || kind == PictureKind::webm;
}
/// UsageError where the name of the file ends in none of these.
PictureKind picture_kind(const std::string& path);

/// Paints on a surface whose unit is the pixel.
using Paint = std::function<void(cairo_surface_t*)>;

/// A file of this kind, which is not a film, `size` in pixels (whole numbers). Files that are printed
/// have `points` points (1/72 inch) for each pixel. `history` is kept inside as text: in PNG as
/// Description, in SVG as desc, in PDF as its subject. The same content gives the same bytes.
/// RunError where cairo fails.
std::string picture_bytes(PictureKind kind, const Vec2& size, double points,
                          const std::string& history, const Paint& paint);

/// The same as pixels of four bytes, row by row: blue, green, red, and one that means nothing.
class Pixels {
 public:
  Pixels(const Vec2& size, const Paint& paint);
  std::span<const std::uint8_t> bytes() const;

 private:
  CairoSurface surface_;
};

}  // namespace grseg
