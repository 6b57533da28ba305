// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/layers.hpp"

#include "formats/core/errors.hpp"

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

double disc_area_within(double radius, double distance, double limit)
{
  const double smaller = std::min(radius, limit);
  if (distance >= radius + limit) return 0;
  if (distance <= std::abs(radius - limit)) return std::numbers::pi * smaller * smaller;
  const double disc = radius * radius, circle = limit * limit, square = distance * distance;
  // Four times the area of the triangle of both centres and a point of intersection (Heron).
  const double triangle = std::sqrt((radius + limit - distance) * (distance + radius - limit) *
                                    (distance - radius + limit) * (distance + radius + limit));
  // atan2, because an arc cosine would lose digits of the small angle of a large circle.
  return disc * std::atan2(triangle, square + disc - circle) +
         circle * std::atan2(triangle, square + circle - disc) - triangle / 2;
}

double sphere_volume_below(double radius, double height)
{
  const double d = std::clamp(height, -radius, radius);
  return std::numbers::pi / 3 * (radius + d) * (radius + d) * (2 * radius - d);
}

Layers::Layers(double thickness, double length, std::optional<double> width, Kind kind)
    : thickness_(thickness), length_(length), width_(width), kind_(std::move(kind))
{
  if (!(thickness > 0) || !std::isfinite(thickness))
    throw UsageError(fmt::format("a layer cannot be {:g} m thick; give e.g. 4dS", thickness));
  if (!(length > 0) || !std::isfinite(length))
    throw UsageError(fmt::format("the length of the cell, {:g} m, must be positive", length));
  if (width && (!(*width > 0) || !std::isfinite(*width)))
    throw UsageError(fmt::format("the width of the cell, {:g} m, must be positive", *width));
}

Layers Layers::annuli(double thickness, double length, const Vec2& axis,
                      std::optional<double> width)
{
  return {thickness, length, width, Annuli{axis}};
}

Layers Layers::map(const MapGrid& cells, double length, std::optional<double> width)
{
  return {cells.thickness(), length, width, cells};
}

Layers Layers::with_thickness(double thickness) const
{
  return {thickness, length_, width_, kind_};
}

double Layers::volume(std::size_t layer) const
{
  if (const auto* cells = map()) return cells->volume(layer);
  const double n = static_cast<double>(layer);
  const double area =
      axis() ? std::numbers::pi * thickness_ * thickness_ * (2 * n + 1) : thickness_ * length_;
  return width_ ? area * *width_ : area;
}

template <int D>
Vector<D> Layers::turned(const Vector<D>& vector, const Vector<D>& position) const
{
  const Vec2* about = axis();
  if (!about) return vector;
  const Vec2 arm = position.template head<2>() - *about, of = vector.template head<2>();
  const double distance = arm.norm();
  const Vec2 outward = distance > 0 ? Vec2(arm / distance) : Vec2(0, 1);
  Vector<D> result = vector;
  result.x() = outward.y() * of.x() - outward.x() * of.y();
  result.y() = outward.dot(of);
  return result;
}

template Vec2 Layers::turned(const Vec2&, const Vec2&) const;
template Vec3 Layers::turned(const Vec3&, const Vec3&) const;

template <int D>
std::size_t Layers::count(const Grains& grains, const Frame<D>& frame) const
{
  if (const auto* cells = map()) return cells->cells();
  double highest = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (is_mobile(grains, frame, g))
      highest = std::max(highest, height<D>(frame.position[g]) + grains.radius[g]);
  if (!(highest < most_layers * thickness_))
    throw RunError(
        fmt::format("at t = {:.6g} s a grain is {:.3g} m {}, more than {:g} layers; either "
                    "the grain is lost, or the layers are too thin",
                    frame.time, highest, axis() ? "from the axis" : "above the base", most_layers));
  const std::size_t n = at(highest);
  return highest > bottom(n) ? n + 1 : std::max<std::size_t>(n, 1);
}

template std::size_t Layers::count(const Grains&, const Frame<2>&) const;
template std::size_t Layers::count(const Grains&, const Frame<3>&) const;

}  // namespace grseg
