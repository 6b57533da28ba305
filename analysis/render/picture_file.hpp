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

/// Format of a file, named by its extension.
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
/// Format of the file `path`. UsageError where its name ends in none of these.
PictureKind picture_kind(const std::string& path);

/// Paints on a surface whose unit is the pixel.
using Paint = std::function<void(cairo_surface_t*)>;

/// Bytes of a picture file; `kind` is no film, `size` in pixels (whole numbers). SVG and PDF have `points`
/// points (1/72 inch) for each pixel. `history` is kept inside as text: in PNG as Description, in SVG
/// as desc, in PDF as subject. The same content gives the same bytes. RunError where cairo fails.
std::string picture_bytes(PictureKind kind, const Vec2& size, double points,
                          const std::string& history, const Paint& paint);

/// A picture as pixels, row by row, four bytes each: blue, green, red, and one without meaning.
class Pixels {
 public:
  Pixels(const Vec2& size, const Paint& paint);
  std::span<const std::uint8_t> bytes() const;

 private:
  CairoSurface surface_;
};

}  // namespace grseg
