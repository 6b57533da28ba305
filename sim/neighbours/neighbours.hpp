// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

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
};

/// The bodies of a cell and where their partners are.
struct Search {
  Range cell{};
  std::uint32_t end = 0;           // in its band from each body on as far as here,
  Range above{};                   // in the band above,
  Range across{}, across_above{};  // and beyond the border of the strip, in both bands,
  double offset = 0;               // m, to add to x of those beyond the border
  double length = 0;               // m, period of x where that does not say which image is meant
};

/// Pairs in the order of their first body a: those of a are begin[a] .. begin[a+1]-1.
struct FoundPairs {
  std::vector<std::uint32_t> begin, b;

  std::size_t size() const { return begin.empty() ? 0 : begin.back(); }
};

/// Adds to `found` the pairs nearer than `skin`, m. `found.begin` must end with the entry of the
/// first body of the cell; `b` holds more than there are pairs, for the memory.
void find_near(const Discs& discs, const Search& search, double skin, FoundPairs& found);

/// Puts 1/x in the place of every x.
void invert(std::span<double> values);

/// What pairs of an old list keep, on its way to the new one: two times two numbers.
struct Carry {
  const std::uint32_t *i, *j;      // of the old pairs: twice the bodies' old indices
  const std::uint32_t* place;      // new index of each old body
  const FoundPairs* found;         // the new pairs;
  const std::uint32_t* number;     // what each is in the new list
  const double *impulse, *memory;  // two per old pair
  double *to_impulse, *to_memory;  // two per new pair
};

/// Carries what the old pairs first .. last-1, both multiples of 8, keep, where their impulse is
/// not zero.
void carry_over(const Carry& task, std::uint32_t first, std::uint32_t last);

}  // namespace grseg
