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

/// Colour from its hexadecimal number 0xRRGGBB, as in 0xd55e00.
constexpr Colour rgb(std::uint32_t hex)
{
  return {static_cast<double>(hex >> 16 & 255) / 255, static_cast<double>(hex >> 8 & 255) / 255,
          static_cast<double>(hex & 255) / 255};
}

/// Mixture of two colours; `share` is the share of b, from 0 to 1.
Colour mix(const Colour& a, const Colour& b, double share);

/// Colours of a picture except the colours of species and fields.
struct Theme {
  Colour background, ink;  // `ink`: colour of text and lines
  Colour faint;            // colour of the edges of the cell
  Colour boundary;         // colour of boundary grains, which have no mobile species
};
inline constexpr Choice<Theme> themes[] = {
    {"light", {rgb(0xffffff), rgb(0x1a1a1a), rgb(0xb8b8b8), rgb(0xa8a8a8)}},
    {"dark", {rgb(0x14171c), rgb(0xe6e6e6), rgb(0x4a505a), rgb(0x6b7280)}}};

/// Colours of one species: `grain` for its grains, `line` for lines of contacts drawn over its grains.
/// species_colours() returns the colours of species `number` (from 0, in order of size) of `count`. They
/// come from the palette of Okabe & Ito (2008): small grains are sky blue, large grains vermilion. If
/// there are more species than colours in the palette, the colours are spread along viridis.
struct SpeciesColours {
  Colour grain, line;
};
SpeciesColours species_colours(std::size_t number, std::size_t count);

/// Colour scale: maps a number from 0 to 1 to a colour; numbers outside get the colour of the nearer end.
using ColourMap = Colour (*)(double place);

/// Perceptually uniform scale from dark blue over green to yellow (S. van der Walt & N. Smith 2015, CC0).
Colour viridis(double place);
/// Colour scale for fields of both signs: blue at 0, almost white at 1/2, vermilion at 1 (Okabe & Ito).
Colour blue_white_red(double place);

}  // namespace grseg
