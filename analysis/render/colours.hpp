// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/words.hpp"

#include <cstddef>
#include <cstdint>

/// Colours that those can tell apart who see fewer of them. Components are sRGB, 0 to 1.
namespace grseg {

struct Colour {
  double red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};

/// 0xd55e00
constexpr Colour rgb(std::uint32_t hex)
{
  return {static_cast<double>(hex >> 16 & 255) / 255, static_cast<double>(hex >> 8 & 255) / 255,
          static_cast<double>(hex & 255) / 255};
}

/// `share` of b, the rest of a.
Colour mix(const Colour& a, const Colour& b, double share);

/// What is not grains or fields.
struct Theme {
  Colour background, ink;  // text and lines
  Colour faint;            // edges of the cell
  Colour boundary;         // grains that belong to none of the species
};
inline constexpr Choice<Theme> themes[] = {
    {"light", {rgb(0xffffff), rgb(0x1a1a1a), rgb(0xb8b8b8), rgb(0xa8a8a8)}},
    {"dark", {rgb(0x14171c), rgb(0xe6e6e6), rgb(0x4a505a), rgb(0x6b7280)}}};

/// Of species `number` of `count`, in order of size: the palette of Okabe & Ito (2008), small grains
/// sky blue and large ones vermilion. More species than it has colours lie along viridis. `line` is the
/// same hue for lines over grains of that colour.
struct SpeciesColours {
  Colour grain, line;
};
SpeciesColours species_colours(std::size_t number, std::size_t count);

/// From a place 0 to 1, beyond which the ends hold, to a colour.
using ColourMap = Colour (*)(double place);

/// Perceptually uniform, from dark blue over green to yellow (S. van der Walt & N. Smith 2015, CC0).
Colour viridis(double place);
/// For what has both signs: blue, almost white at 1/2, vermilion, the colours of Okabe & Ito.
Colour blue_white_red(double place);

}  // namespace grseg
