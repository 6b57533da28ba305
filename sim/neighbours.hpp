// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/frame.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

/// The parts of the pair list that look at every grain, with vector instructions. All instruction
/// sets give the same bytes.
namespace grseg {

/// Indices of bodies, `end` not among them.
struct Range {
  std::uint32_t begin, end;
};

/// The box that a set of displacements spans, m.
struct Extent {
  Vec2 low, high;
};

/// How far the bodies of each group have moved from `from` to `to`; low is above high where there
/// are none.
void measure_displacements(std::span<const Vec2> from, std::span<const Vec2> to,
                           std::span<const Range> groups, std::span<Extent> moved);

/// Bodies, member by member; eight more than there are.
struct Discs {
  std::vector<double> x, y, radius;  // m
  std::vector<double> inverse_mass;  // 1/kg
};

/// Pairs in the order of their first body a: those of a are begin[a] .. begin[a+1]-1.
struct FoundPairs {
  std::vector<std::uint32_t> begin, b;

  std::size_t size() const { return begin.empty() ? 0 : begin.back(); }
};

/// The bodies of a cell and where to look for their partners.
struct Search {
  Range cell;
  std::uint32_t end;               // partners behind a body in its band, as far as here
  std::array<Range, 3> elsewhere;  // and in these ranges
  double skin;                     // m
  double length;                   // m, period of x, 0 without
};

/// Adds to `found` the pairs nearer than `skin` of which at least one body moves. `found.begin`
/// must have an entry for the first body of the cell.
void find_near(const Discs& discs, const Search& search, FoundPairs& found);

}  // namespace grseg
