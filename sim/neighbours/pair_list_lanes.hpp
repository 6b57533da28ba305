// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/contact/contact_blocks.hpp"

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

/// Loops of the pair list over all grains or pairs; the same bytes on all instruction sets.
namespace grseg {

/// Bounding box of a set of displacements, m, or velocities, m/s; empty for an empty set.
using Extent = Eigen::AlignedBox2d;

/// Writes, per group, the extent of the displacements of its bodies from `from` to `to`, m.
void measure_displacements(std::span<const Vec2> from, std::span<const Vec2> to,
                           std::span<const Range> groups, std::span<Extent> moved);

/// Positions and radii of all bodies, one array per member, each with eight additional entries.
struct Discs {
  std::vector<double> x, y, radius;  // m
};

/// Bodies of a cell, and ranges of bodies among which the partners of their pairs are searched.
struct Search {
  Range cell{};                    // bodies of the cell
  std::uint32_t end = 0;           // end of the partners (after the body) in the band of the cell
  Range above{};                   // partners in the band above
  Range across{}, across_above{};  // partners beyond the border of the strip, in both bands
  double offset = 0;               // m, added to x of partners beyond the border
  double length = 0;               // m, period of x if both images must be tried, else 0
};

/// Pairs in the order of their first body a: pairs begin[a] .. begin[a+1]-1, with second bodies b.
struct FoundPairs {
  std::vector<std::uint32_t> begin, b;

  std::size_t size() const { return begin.empty() ? 0 : begin.back(); }
};

/// Appends to `found` the pairs whose gap is at most `skin`, m. The last entry of `found.begin`
/// must belong to the first body of the cell; `found.b` may have more entries than there are pairs.
void find_near(const Discs& discs, const Search& search, double skin, FoundPairs& found);

/// Memories of the pairs in an old list, and data that locate the same pairs in the new list.
struct CarryOver {
  const std::uint32_t *i, *j;   // per old pair, twice the old indices of its bodies
  const std::uint32_t* place;   // per old index of a body, its new index
  const FoundPairs* found;      // pairs of the new list
  const std::uint32_t* number;  // per pair in `found`, its entry in the new list
  const double* memory;         // Pairs::Memory of the old pairs, four doubles each
  double* to_memory;            // Pairs::Memory of the new pairs
};

/// Copies the memories of old pairs first .. last-1 that have an impulse and are in the new list;
/// `first` and `last` are multiples of 8.
void carry_over(const CarryOver& task, std::uint32_t first, std::uint32_t last);

}  // namespace grseg
