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
/// Format of the file `path`. Throws UsageError if the name has another extension.
PictureKind picture_kind(const std::string& path);

/// Function that paints a picture on a surface whose unit is the pixel.
using Paint = std::function<void(cairo_surface_t*)>;

/// Bytes of a picture file. `kind` is not a film; `size` in pixels (whole numbers). `points`: size of a
/// pixel in SVG and PDF, points (1/72 inch). The file stores `history` as text: PNG as Description, SVG as
/// desc, PDF as subject. Equal content gives equal bytes. Throws RunError if cairo fails.
std::string picture_bytes(PictureKind kind, const Vec2& size, double points,
                          const std::string& history, const Paint& paint);

/// A picture as pixels, row by row. A pixel has four bytes: blue, green, red, and an unused one.
class Pixels {
 public:
  Pixels(const Vec2& size, const Paint& paint);
  std::span<const std::uint8_t> bytes() const;

 private:
  CairoSurface surface_;
};

}  // namespace grseg
