// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/colours.hpp"

#include <algorithm>
#include <iterator>
#include <span>

namespace grseg {
namespace {

/// Okabe & Ito (2008), "Color Universal Design".
constexpr Colour orange = rgb(0xe69f00), sky_blue = rgb(0x56b4e9), green = rgb(0x009e73),
                 yellow = rgb(0xf0e442), blue = rgb(0x0072b2), vermilion = rgb(0xd55e00),
                 purple = rgb(0xcc79a7);

constexpr SpeciesColours palette[] = {{sky_blue, blue}, {vermilion, vermilion}, {green, green},
                                      {purple, purple}, {orange, orange},       {yellow, yellow}};

/// Matplotlib's viridis in steps of 1/20. Linear interpolation between these colours is off by 3/255 at most.
constexpr Colour viridis_stops[] = {
    rgb(0x440154), rgb(0x481466), rgb(0x482476), rgb(0x463480), rgb(0x414487), rgb(0x3b528b),
    rgb(0x34608d), rgb(0x2f6c8e), rgb(0x2a788e), rgb(0x25848e), rgb(0x21908c), rgb(0x1e9c89),
    rgb(0x22a884), rgb(0x2fb47c), rgb(0x43be70), rgb(0x5cc863), rgb(0x7ad151), rgb(0x9ad93c),
    rgb(0xbcde27), rgb(0xdee318), rgb(0xfde725)};

constexpr Colour signed_stops[] = {blue, rgb(0xf2f2f2), vermilion};

Colour between(std::span<const Colour> stops, double place)
{
  const double at = std::clamp(place, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  return mix(stops[stop], stops[stop + 1], at - static_cast<double>(stop));
}

}  // namespace

Colour mix(const Colour& a, const Colour& b, double share)
{
  const auto part = [share](double from, double to) { return from + share * (to - from); };
  return {part(a.red, b.red), part(a.green, b.green), part(a.blue, b.blue)};
}

SpeciesColours species_colours(std::size_t number, std::size_t count)
{
  if (count <= std::size(palette)) return palette[number];
  const auto colour = viridis(static_cast<double>(number) / static_cast<double>(count - 1));
  return {colour, colour};
}

Colour viridis(double place)
{
  return between(viridis_stops, place);
}

Colour blue_white_red(double place)
{
  return between(signed_stops, place);
}

}  // namespace grseg
