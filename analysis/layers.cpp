// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/layers.hpp"

#include "formats/errors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

constexpr double most_layers = 100000;

}  // namespace

double disc_area_below(double radius, double height)
{
  const double square = radius * radius;
  if (height >= radius) return std::numbers::pi * square;
  const double d = std::max(height, -radius);
  return square * (std::numbers::pi / 2 + std::asin(d / radius)) + d * std::sqrt(square - d * d);
}

Layers::Layers(double thickness, double length) : thickness_(thickness), length_(length)
{
  if (!(thickness > 0) || !std::isfinite(thickness))
    throw UsageError(fmt::format("a layer of {:g} m has no thickness; give e.g. 4dS", thickness));
  if (!(length > 0) || !std::isfinite(length))
    throw UsageError(fmt::format("a cell of {:g} m has no length", length));
}

std::size_t Layers::count(const Grains& grains, const Frame& frame) const
{
  double highest = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, g)) highest = std::max(highest, frame.position[g].y() + grains.radius[g]);
  if (!(highest < most_layers * thickness_))
    throw RunError(
        fmt::format("at t = {:.6g} s a grain is {:.3g} m above the base, more than {:g} layers; is "
                    "it lost, or are the layers too thin?",
                    frame.time, highest, most_layers));
  const std::size_t n = at(highest);
  return highest > bottom(n) ? n + 1 : std::max<std::size_t>(n, 1);
}

}  // namespace grseg
