// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace grseg {

/// Area (m^2) of the part of a disc that lies below a line `height` (m) above its centre; exact,
/// 0 below the disc and pi r^2 above it.
double disc_area_below(double radius, double height);

/// Area (m^2) of the part of a disc that lies within a circle of radius `limit` (m) whose centre is
/// `distance` (m) from the disc's: two circular segments.
double disc_area_within(double radius, double distance, double limit);

/// Layers parallel to the base: layer n is [n h, (n+1) h), of volume V = Lx h. The first also takes
/// all that is below y = 0, and the last all that is above it. There are as many as the highest
/// mobile grain reaches; the last one keeps its full thickness and volume.
///
/// Or annuli about an axis, as a drum asks for: y is then the distance from the axis, outward, and
/// x goes round it clockwise, so that (x, y) is right-handed as over a base. Annulus n is [n h,
/// (n+1) h), of volume pi h^2 (2 n + 1).
class Layers {
 public:
  /// Thickness h and length Lx of the cell, m. UsageError unless both are positive.
  Layers(double thickness, double length);
  static Layers annuli(double thickness, double length, const Vec2& axis);
  /// The same with another thickness.
  Layers with_thickness(double thickness) const;

  const std::optional<Vec2>& axis() const { return axis_; }  // of annuli
  double thickness() const { return thickness_; }
  double volume(std::size_t layer) const;    // m^2
  double length() const { return length_; }  // m
  // Multiplying, not adding up: edges are the same in every tool and stay exact.
  double bottom(std::size_t layer) const { return static_cast<double>(layer) * thickness_; }
  double top(std::size_t layer) const { return bottom(layer + 1); }

  /// y of a position, m.
  double height(const Vec2& position) const
  {
    return axis_ ? (position - *axis_).norm() : position.y();
  }
  /// Components along and across the layer of a vector at `position`.
  Vec2 turned(const Vec2& vector, const Vec2& position) const;

  /// The layer that holds the height y, m.
  std::size_t at(double y) const;
  /// Layers up to the top of the highest mobile grain, at least 1. RunError where that would be
  /// more than a bed can have, which means that a grain is lost.
  std::size_t count(const Grains& grains, const Frame<2>& frame) const;

  /// Calls book(layer, share) with the shares of its length that a straight segment between two
  /// heights has in each of `count` layers; the shares add up to 1. Not of annuli.
  template <class Book>
  void share_segment(double from, double to, std::size_t count, const Book& book) const;

  /// Calls book(layer, area) with the areas (m^2) that a disc at height y has in each of `count`
  /// layers; they add up to pi r^2.
  template <class Book>
  void share_disc(double y, double radius, std::size_t count, const Book& book) const;

 private:
  /// Of a disc at height y, the area below the top of a layer.
  double area_below_top(std::size_t layer, double y, double radius) const
  {
    return axis_ ? disc_area_within(radius, y, top(layer))
                 : disc_area_below(radius, top(layer) - y);
  }

  double thickness_, length_;
  std::optional<Vec2> axis_;
};

inline std::size_t Layers::at(double y) const
{
  if (!(y >= thickness_)) return 0;
  auto n = static_cast<std::size_t>(y / thickness_);
  // The quotient may be rounded to the wrong side of an edge.
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

template <class Book>
void Layers::share_disc(double y, double radius, std::size_t count, const Book& book) const
{
  const std::size_t first = std::min(at(y - radius), count - 1);
  const std::size_t last = std::min(at(y + radius), count - 1);
  double below = 0;
  for (std::size_t n = first; n <= last; ++n) {
    const double up_to_here =
        n == last ? disc_area_below(radius, radius) : area_below_top(n, y, radius);
    book(n, up_to_here - below);
    below = up_to_here;
  }
}

}  // namespace grseg
