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
  Vec2 point;  // m, a point on the surface of the wall
  Vec2 normal;
};

/// Signed distance of the point x from the wall, m; negative behind the wall.
inline double distance_to(const Wall& wall, const Vec2& x)
{
  return (x - wall.point).dot(wall.normal);
}

/// Pairs of the pair list, class by class: all pairs of a class have the same colour (PairColours),
/// or the same wall. No mobile body appears twice in a class unless it is `alone`. Data that are
/// read for single pairs lie side by side in memory.
struct Pairs {
  struct Geometry {
    double shift;  ///< m, added to x_i - x_j to obtain the nearest periodic image
    double reach;  ///< m, distance at which the pair touches: r_i + r_j, or r_i at a wall
  };
  /// State of a pair after the previous step; all 0 for a pair that did not act.
  struct alignas(32) Memory {
    double n, t;      ///< kg m/s, normal and tangential impulse
    double approach;  ///< m/s, approach of a pair that was slowed down (Rebound::remembered)
    double unused;
  };
  struct Class {
    std::uint32_t begin, end;  ///< first entry and end, multiples of 8
    std::int32_t wall;         ///< number of the wall, or -1 for pairs of grains
    bool alone;    ///< pairs that got no colour, because a body has more pairs than colours
    bool on_base;  ///< true if the partners j do not move
  };

  /// Twice the index of each body: offset of its position, in doubles. i is mobile.
  std::vector<std::uint32_t> i, j;
  std::vector<Geometry> geometry;
  std::vector<Memory> memory;
  /// Classes, strip by strip (pair_search.hpp); in a strip first pairs of mobile grains, then pairs
  /// with a boundary grain, then pairs at walls. Entries that pad a class to a multiple of 8 have
  /// reach NaN. The entry after the last pair is the neutral pair: the immobile body with itself.
  std::vector<Class> classes;
  /// Index of the first class of each strip, then the number of classes. Pairs of strips that are
  /// not neighbours share no mobile body.
  std::vector<std::uint32_t> strips{0, 0};

  std::size_t strip_count() const { return strips.size() - 1; }
  std::span<const Class> classes_of(std::size_t strip) const
  {
    return std::span(classes).subspan(strips[strip], strips[strip + 1] - strips[strip]);
  }
  /// Index of the first pair of a strip.
  std::uint32_t begin_of(std::size_t strip) const
  {
    const auto of_strip = classes_of(strip);
    return of_strip.empty() ? 0 : of_strip.front().begin;
  }

  /// Number of entries without the neutral pair.
  std::size_t size() const { return i.empty() ? 0 : i.size() - 1; }
  bool listed(std::size_t k) const { return geometry[k].reach > 0; }
};

}  // namespace grseg
