// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/contact/contact_law.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace grseg {

/// A flat wall: the half-plane (spheres: half-space) behind `point`, of infinite mass. `normal`
/// (unit length) points into the space that is free to grains.
template <int D>
struct Wall {
  Vector<D> point;  // m, a point on the surface of the wall
  Vector<D> normal;
};

/// Signed distance of the point x from the wall, m; negative behind the wall.
template <int D>
double distance_to(const Wall<D>& wall, const Vector<D>& x)
{
  return (x - wall.point).dot(wall.normal);
}

/// Where a pair touches.
template <int D>
struct PairGeometry {
  double shift;  ///< m, added to x_i - x_j to obtain the nearest periodic image
  double reach;  ///< m, distance at which the pair touches: r_i + r_j, or r_i at a wall
  bool listed() const { return reach > 0; }
};
/// Shifts of a pair of spheres along x and z. Its reach follows from the radii in Position.
template <>
struct PairGeometry<3> {
  double shift, shift_z;  ///< m, as above
  bool listed() const { return shift_z == shift_z; }
};

/// State of a pair after the previous step; all 0 for a pair that did not act. Four numbers, which
/// one load reads; the approach of spheres is in Pairs::approach.
template <int D>
struct alignas(32) PairMemory {
  double n = 0;            ///< kg m/s, normal impulse
  Turning<D, double> t{};  ///< kg m/s, tangential impulse
  double approach = 0;     ///< m/s, of a pair that was slowed down (Rebound::remembered)
  double unused = 0;
};
template <>
struct alignas(32) PairMemory<3> {
  double n = 0;
  Turning<3, double> t{};
};
constexpr std::uint32_t memory_doubles = sizeof(PairMemory<2>) / sizeof(double);
static_assert(sizeof(PairMemory<2>) == sizeof(PairMemory<3>));

/// A class of pairs, see Pairs.
struct PairClass {
  std::uint32_t begin, end;  ///< first entry and end, multiples of 8
  std::uint32_t near_end;    ///< end of the entries that can be near (FoundPairs)
  std::int32_t wall;         ///< number of the wall, or -1 for pairs of grains
  bool alone;    ///< pairs that got no colour, because a body has more pairs than colours
  bool on_base;  ///< true if the partners j do not move
};

/// Pairs of the pair list, class by class: all pairs of a class have the same colour (PairColours),
/// or the same wall. No mobile body appears twice in a class unless it is `alone`. Data that are
/// read for single pairs lie side by side in memory.
template <int D>
struct Pairs {
  /// Offset of each body's position, in doubles: index times position_doubles<D>. i is mobile.
  std::vector<std::uint32_t> i, j;
  std::vector<PairGeometry<D>> geometry;
  std::vector<PairMemory<D>> memory;
  std::vector<double> approach;  ///< m/s, of spheres, as in PairMemory<2>
  /// Classes, strip by strip (pair_search.hpp); in a strip first pairs of mobile grains, then pairs
  /// with a boundary grain, then pairs at walls. Entries that pad a class to a multiple of 8 are
  /// not listed and never touch: a number of their geometry is NaN. The entry after the last pair
  /// is the neutral pair: the immobile body with itself.
  std::vector<PairClass> classes;
  /// Index of the first class of each strip, then the number of classes. Pairs of strips that are
  /// not neighbours share no mobile body.
  std::vector<std::uint32_t> strips{0, 0};

  std::size_t strip_count() const { return strips.size() - 1; }
  std::span<const PairClass> classes_of(std::size_t strip) const
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
  bool listed(std::size_t k) const { return geometry[k].listed(); }

  double approach_of(std::size_t k) const
  {
    if constexpr (D == 2)
      return memory[k].approach;
    else
      return approach[k];
  }
  void set_memory(std::size_t k, double n, const Turning<D, double>& t, double of_approach)
  {
    if constexpr (D == 2)
      memory[k] = {n, t, of_approach};
    else
      memory[k] = {n, t}, approach[k] = of_approach;
  }
  /// Clears the memories of pairs begin .. end-1.
  void clear_memories(std::size_t begin, std::size_t end)
  {
    const auto clear = [&](auto& numbers) {
      std::fill_n(numbers.begin() + static_cast<std::ptrdiff_t>(begin), end - begin,
                  typename std::decay_t<decltype(numbers)>::value_type{});
    };
    clear(memory);
    if constexpr (D == 3) clear(approach);
  }
};

}  // namespace grseg
