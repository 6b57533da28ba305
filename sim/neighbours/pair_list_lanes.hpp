// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/contact/contact_blocks.hpp"

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

/// The parts of the pair list that visit every grain or pair, with vector instructions. All
/// instruction sets give the same bytes.
namespace grseg {

/// Bounding box of a set of displacements, m, or of velocities, m/s; empty for none.
using Extent = Eigen::AlignedBox2d;

/// Extents of the displacements of each group's bodies from `from` to `to`, m.
void measure_displacements(std::span<const Vec2> from, std::span<const Vec2> to,
                           std::span<const Range> groups, std::span<Extent> moved);

/// Bodies, member by member, and room for eight more.
struct Discs {
  std::vector<double> x, y, radius;  // m
};

/// The bodies of a cell, and the ranges in which their partners are.
struct Search {
  Range cell{};
  std::uint32_t end = 0;           // in the band of the cell: from each body up to here
  Range above{};                   // in the band above
  Range across{}, across_above{};  // beyond the border of the strip, in both bands
  double offset = 0;               // m, to add to x of those beyond the border
  double length = 0;               // m, period of x if either image may be the nearest, else 0
};

/// Pairs in the order of their first body: pairs begin[a] .. begin[a+1]-1 belong to body a.
struct FoundPairs {
  std::vector<std::uint32_t> begin, b;

  std::size_t size() const { return begin.empty() ? 0 : begin.back(); }
};

/// Adds to `found` the pairs whose gap is at most `skin`, m. `found.begin` must end with the entry
/// of the first body of the cell; `b` may be longer than there are pairs.
void find_near(const Discs& discs, const Search& search, double skin, FoundPairs& found);

/// Memories of the pairs in an old list, and their places in the new one.
struct CarryOver {
  const std::uint32_t *i, *j;   // of the old pairs: twice the bodies' old indices
  const std::uint32_t* place;   // new index of each old body
  const FoundPairs* found;      // the new pairs
  const std::uint32_t* number;  // entry of each in the new list
  const double* memory;         // Pairs::Memory, four per old pair
  double* to_memory;            // and per new pair
};

/// Copies the memories of pairs that stay and have an impulse: old pairs first .. last-1, both
/// multiples of 8.
void carry_over(const CarryOver& task, std::uint32_t first, std::uint32_t last);

}  // namespace grseg
