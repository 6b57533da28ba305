// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/picture_file.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/text.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>
#include <libdeflate.h>

#include <filesystem>

namespace grseg {
namespace {

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length)
{
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void require_success(cairo_status_t status)
{
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw RunError(
        fmt::format("cairo cannot paint the picture: {}", cairo_status_to_string(status)));
}

CairoSurface image_surface(const Vec2& size)
{
  CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(size.x()),
                                                  static_cast<int>(size.y())));
  require_success(cairo_surface_status(surface.get()));
  return surface;
}

std::string big_endian(std::uint32_t number)
{
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<char>(number >> shift & 255));
  return bytes;
}

/// PNG chunk with text in UTF-8 (PNG 1.2, section 4.2.3.3).
std::string text_chunk(const std::string& keyword, const std::string& text)
{
  const std::string zero(1, '\0');
  // The zero bytes mean: not compressed, no language given.
  const auto typed = "iTXt" + keyword + zero + zero + zero + zero + zero + text;
  const auto length = static_cast<std::uint32_t>(typed.size() - 4);
  return big_endian(length) + typed + big_endian(libdeflate_crc32(0, typed.data(), typed.size()));
}

std::string png_bytes(const Vec2& size, const std::string& history, const Paint& paint)
{
  const auto surface = image_surface(size);
  paint(surface.get());
  std::string bytes;
  require_success(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
  // Size of the signature and of the first chunk, IHDR, bytes.
  constexpr std::size_t begin = 8 + 25;
  bytes.insert(begin, text_chunk("Description", history));
  return bytes;
}

std::string vector_bytes(PictureKind kind, const Vec2& size, double points,
                         const std::string& history, const Paint& paint)
{
  std::string bytes;
  const auto create = kind == PictureKind::svg ? cairo_svg_surface_create_for_stream
                                               : cairo_pdf_surface_create_for_stream;
  CairoSurface surface(create(append, &bytes, points * size.x(), points * size.y()));
  require_success(cairo_surface_status(surface.get()));
  if (kind == PictureKind::pdf) {
    // Without a date, since a date would make the bytes of each file different.
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, nullptr);
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_SUBJECT, history.c_str());
  }
  cairo_surface_set_device_scale(surface.get(), points, points);
  paint(surface.get());
  cairo_surface_finish(surface.get());
  require_success(cairo_surface_status(surface.get()));
  if (kind == PictureKind::svg) {
    const auto begin = bytes.find('>', bytes.find("<svg")) + 1;
    bytes.insert(begin, "\n<desc>" + xml_escaped(history) + "</desc>");
  }
  return bytes;
}

}  // namespace

PictureKind picture_kind(const std::string& path)
{
  const auto extension = std::filesystem::path(path).extension().string();
  if (!extension.empty())
    if (const auto kind = find_choice(extension.substr(1), picture_kinds)) return *kind;
  throw UsageError(
      fmt::format("-o '{}': name a picture that ends in .png, .svg or .pdf, or a film that ends in "
                  ".mp4 or .webm",
                  path));
}

std::string picture_bytes(PictureKind kind, const Vec2& size, double points,
                          const std::string& history, const Paint& paint)
{
  if (kind == PictureKind::png) return png_bytes(size, history, paint);
  return vector_bytes(kind, size, points, history, paint);
}

Pixels::Pixels(const Vec2& size, const Paint& paint) : surface_(image_surface(size))
{
  paint(surface_.get());
  cairo_surface_flush(surface_.get());
}

std::span<const std::uint8_t> Pixels::bytes() const
{
  // The stride is the length of a row, bytes; with four bytes per pixel there are no gaps between rows.
  const auto row = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_.get()));
  const auto rows = static_cast<std::size_t>(cairo_image_surface_get_height(surface_.get()));
  return {cairo_image_surface_get_data(surface_.get()), row * rows};
}

}  // namespace grseg
