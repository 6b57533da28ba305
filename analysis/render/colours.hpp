// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/words.hpp"

#include <cstddef>
#include <cstdint>

/// Colour-blind safe palette. Components are sRGB, 0 to 1.
namespace grseg {

struct Colour {
  double red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};

/// The colour 0xRRGGBB, as in 0xd55e00.
constexpr Colour rgb(std::uint32_t hex)
{
  return {static_cast<double>(hex >> 16 & 255) / 255, static_cast<double>(hex >> 8 & 255) / 255,
          static_cast<double>(hex & 255) / 255};
}

/// `share` of b, the rest of a.
Colour mix(const Colour& a, const Colour& b, double share);

/// Colours of a picture, without species and fields.
struct Theme {
  Colour background, ink;  // text and lines
  Colour faint;            // edges of the cell
  Colour boundary;         // grains that belong to none of the species
};
inline constexpr Choice<Theme> themes[] = {
    {"light", {rgb(0xffffff), rgb(0x1a1a1a), rgb(0xb8b8b8), rgb(0xa8a8a8)}},
    {"dark", {rgb(0x14171c), rgb(0xe6e6e6), rgb(0x4a505a), rgb(0x6b7280)}}};

/// Colours of species `number` of `count`, counted from 0 in order of size. They come from the palette of
/// Okabe & Ito (2008): small grains are sky blue, large ones vermilion. If there are more species than the
/// palette has colours, they are spread along viridis. `line` is the hue for lines over such grains.
struct SpeciesColours {
  Colour grain, line;
};
SpeciesColours species_colours(std::size_t number, std::size_t count);

/// Gives the colour of a place from 0 to 1; places beyond have the colours of the ends.
using ColourMap = Colour (*)(double place);

/// Perceptually uniform, from dark blue over green to yellow (S. van der Walt & N. Smith 2015, CC0).
Colour viridis(double place);
/// Map for fields of both signs: blue, almost white at 1/2, vermilion, the colours of Okabe & Ito.
Colour blue_white_red(double place);

}  // namespace grseg
