// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace grseg {

/// A straight wall: the half-plane behind `point`, of infinite mass. `normal` (unit length) points
/// into the space that is free to grains.
struct Wall {
  Vec2 point;  // m
  Vec2 normal;
};

/// m; below 0 behind the wall.
inline double distance_to(const Wall& wall, const Vec2& x)
{
  return (x - wall.point).dot(wall.normal);
}

/// Listed pairs, class by class: a class is a colour, or a wall. No mobile body appears twice in a
/// class, except where `alone`. What is read for single pairs lies side by side.
struct Pairs {
  struct Geometry {
    double shift;  ///< m, to add to x_i - x_j for the nearest periodic image
    double reach;  ///< m, distance at which the pair touches: r_i + r_j, at a wall r_i
  };
  /// State of a pair after the last step; all 0 for a pair that did not act.
  struct alignas(32) Memory {
    double n, t;      ///< kg m/s, its impulse
    double approach;  ///< m/s, of a pair that was slowed down (Rebound::remembered)
    double unused;
  };
  struct Class {
    std::uint32_t begin, end;  ///< multiples of 8
    std::int32_t wall;         ///< number of the wall, or -1 for pairs of grains
    bool alone;    ///< pairs left without a colour, as a body has more pairs than colours
    bool on_base;  ///< the partners j do not move
  };

  /// Twice the body's index: where its position begins, counted in doubles. i is mobile.
  std::vector<std::uint32_t> i, j;
  std::vector<Geometry> geometry;
  std::vector<Memory> memory;
  /// Strip by strip; in a strip pairs of mobile grains first, then those with boundary grains, then
  /// those at walls. Entries that pad a class to a multiple of 8 have reach NaN. The entry after
  /// the last pair is neutral: the body that never moves, with itself.
  std::vector<Class> classes;
  /// First class of each strip, then the number of classes. Pairs of strips that are not neighbours
  /// share no mobile body.
  std::vector<std::uint32_t> strips{0, 0};

  std::size_t strip_count() const { return strips.size() - 1; }
  std::span<const Class> classes_of(std::size_t strip) const
  {
    return std::span(classes).subspan(strips[strip], strips[strip + 1] - strips[strip]);
  }
  /// First entry of a strip.
  std::uint32_t begin_of(std::size_t strip) const
  {
    const auto of_strip = classes_of(strip);
    return of_strip.empty() ? 0 : of_strip.front().begin;
  }

  /// Number of entries but the neutral one.
  std::size_t size() const { return i.empty() ? 0 : i.size() - 1; }
  bool listed(std::size_t k) const { return geometry[k].reach > 0; }
};

}  // namespace grseg
