// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/map_grid.hpp"
#include "formats/core/frame.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <variant>

namespace grseg {

/// Area (m^2) of the part of a disc that lies below a line `height` (m) above its centre. Exactly 0
/// for a line below the disc, and pi r^2 for one above the disc.
double disc_area_below(double radius, double height);

/// Area (m^2) of the intersection of a disc and a circle of radius `limit` (m) whose centres are
/// `distance` (m) apart. It consists of two circular segments.
double disc_area_within(double radius, double distance, double limit);

/// Volume (m^3) of the part of a sphere that lies below a plane `height` (m) above its centre.
double sphere_volume_below(double radius, double height);

/// Layers, annuli or cells of a map over which quantities are summed.
///
/// Layer n parallel to the base is [n h, (n+1) h), of volume V = Lx h in two dimensions and Lx Lz h
/// in three. The last layer contains the top of the highest mobile grain; its volume is V. The
/// first layer also includes everything below y = 0, and the last layer everything above it. A
/// FrameLoop leaves out grains that are far below, such as grains that have left a hopper
/// (grains_below.hpp).
///
/// Annuli, as for a drum, lie about an axis along z: y is then the distance from the axis, and x
/// runs clockwise round it, so that (x, y) is right-handed as over a base. Annulus n is [n h, (n+1)
/// h), of volume pi h^2 (2 n + 1), in three dimensions times Lz.
///
/// In a map (map_grid.hpp) a "layer" is a cell, and y is the coordinate across it. A grain or
/// contact belongs to one cell as a whole.
class Layers {
 public:
  /// Thickness h of layers, and length Lx and (in three dimensions) width Lz of the periodic cell,
  /// m. Throws UsageError unless they are positive.
  Layers(double thickness, double length, std::optional<double> width = std::nullopt)
      : Layers(thickness, length, width, Parallel{})
  {
  }
  /// Annuli about an axis along z; `axis` has its x and y, m.
  static Layers annuli(double thickness, double length, const Vec2& axis,
                       std::optional<double> width = std::nullopt);
  static Layers map(const MapGrid& cells, double length, std::optional<double> width);
  /// Copy of these layers with another thickness; not for a map.
  Layers with_thickness(double thickness) const;

  /// x and y of the axis of annuli or of a map rz, m; null for others.
  const Vec2* axis() const;
  /// The cells of a map; null for layers and annuli.
  const MapGrid* map() const { return std::get_if<MapGrid>(&kind_); }
  double thickness() const { return thickness_; }
  double volume(std::size_t layer) const;                        // volume of a layer, m^2 or m^3
  double length() const { return length_; }                      // Lx, m
  const std::optional<double>& width() const { return width_; }  // Lz, m; only in three dimensions
  /// Volume of a bed of this height, m^2 or m^3.
  double volume_of_bed(double height) const { return length_ * width_.value_or(1) * height; }
  // Edges are products, not sums, so that they are exact and the same in every tool.
  double bottom(std::size_t layer) const { return static_cast<double>(layer) * thickness_; }
  double top(std::size_t layer) const { return bottom(layer + 1); }

  /// Coordinate y of a position, m: the height, or the distance from the axis.
  template <int D>
  double height(const Vector<D>& position) const
  {
    const Vec2* about = axis();
    return about ? Vec2(position.template head<2>() - *about).norm() : position.y();
  }
  /// Components along and across the layer of a vector at `position`. Its z component is unchanged.
  template <int D>
  Vector<D> turned(const Vector<D>& vector, const Vector<D>& position) const;
  /// Components along and across the layer of a spin at `position`; unchanged in two dimensions.
  template <int D>
  Spin<D> turned_spin(const Spin<D>& spin, const Vector<D>& position) const
  {
    if constexpr (D == 2)
      return spin;
    else
      return turned<D>(spin, position);
  }

  /// Number of the layer that contains the height y, m; not for a map.
  std::size_t at(double y) const;
  /// Number of the layer or cell that contains a position at height y.
  template <int D>
  std::size_t holding(const Vector<D>& position, double y) const
  {
    if (const auto* cells = map()) [[unlikely]]
      return cells->at<D>(position);
    return at(y);
  }
  /// Height of y above the bottom of a layer or cell, m.
  double above_bottom(double y, std::size_t layer) const
  {
    const auto* cells = map();
    return y - (cells ? cells->bottom(layer) : bottom(layer));
  }
  /// Number of layers up to the top of the highest mobile grain, at least 1; number of cells of a
  /// map. Throws RunError above 100,000 layers, which means that a grain is lost.
  template <int D>
  std::size_t count(const Grains& grains, const Frame<D>& frame) const;

  /// Divides a straight segment between two heights among `count` layers: calls book(layer, share)
  /// with the share of its length in each layer. The shares add up to 1. Not for annuli or maps.
  template <class Book>
  void share_segment(double from, double to, std::size_t count, const Book& book) const;

  /// Divides a disc or sphere at height y among `count` layers: calls book(layer, part) with its
  /// area (m^2) or volume (m^3) in each layer. The parts add up to the area or volume of the grain.
  /// Not for spheres in annuli, nor for maps.
  template <int D, class Book>
  void share_grain(double y, double radius, std::size_t count, const Book& book) const;

 private:
  /// Part of a grain at height y that lies below the top of a layer, m^2 or m^3.
  template <int D>
  double part_below_top(std::size_t layer, double y, double radius) const
  {
    if constexpr (D == 3) return sphere_volume_below(radius, top(layer) - y);
    return axis() ? disc_area_within(radius, y, top(layer))
                  : disc_area_below(radius, top(layer) - y);
  }

  struct Parallel {};
  struct Annuli {
    Vec2 axis;
  };
  using Kind = std::variant<Parallel, Annuli, MapGrid>;
  Layers(double thickness, double length, std::optional<double> width, Kind kind);

  double thickness_, length_;
  std::optional<double> width_;
  Kind kind_;
};

inline const Vec2* Layers::axis() const
{
  if (std::holds_alternative<Parallel>(kind_)) [[likely]]
    return nullptr;
  if (const auto* annuli = std::get_if<Annuli>(&kind_)) return &annuli->axis;
  const auto& of_map = map()->axis;
  return of_map ? &*of_map : nullptr;
}

inline std::size_t Layers::at(double y) const
{
  if (!(y >= thickness_)) return 0;
  auto n = static_cast<std::size_t>(y / thickness_);
  // Rounding may move the quotient across an edge.
  if (y < bottom(n)) --n;
  if (y >= top(n)) ++n;
  return n;
}

template <class Book>
void Layers::share_segment(double from, double to, std::size_t count, const Book& book) const
{
  const double low = std::min(from, to), high = std::max(from, to);
  const std::size_t first = std::min(at(low), count - 1), last = std::min(at(high), count - 1);
  if (first == last) {
    book(first, 1.0);
    return;
  }
  for (std::size_t n = first; n <= last; ++n) {
    const double begin = n == first ? low : bottom(n);
    const double end = n == last ? high : top(n);
    book(n, (end - begin) / (high - low));
  }
}

template <int D, class Book>
void Layers::share_grain(double y, double radius, std::size_t count, const Book& book) const
{
  const std::size_t first = std::min(at(y - radius), count - 1);
  const std::size_t last = std::min(at(y + radius), count - 1);
  const double whole =
      D == 2 ? disc_area_below(radius, radius) : sphere_volume_below(radius, radius);
  double below = 0;
  for (std::size_t n = first; n <= last; ++n) {
    const double up_to_here = n == last ? whole : part_below_top<D>(n, y, radius);
    book(n, up_to_here - below);
    below = up_to_here;
  }
}

}  // namespace grseg
