// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "sim/contact/contact_blocks.hpp"
#include "sim/neighbours/grain_state.hpp"
#include "sim/neighbours/pairs.hpp"

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

/// Loops of the pair list over all grains or pairs; the same bytes on all instruction sets.
namespace grseg {

/// Bounding box of a set of displacements, m, or velocities, m/s; empty for an empty set.
template <int D>
using Extent = Eigen::AlignedBox<double, D>;

/// Writes, per group, the extent of the displacements of its bodies from `from` to `to`, m.
template <int D>
void measure_displacements(std::span<const Position<D>> from, std::span<const Position<D>> to,
                           std::span<const Range> groups, std::span<Extent<D>> moved);

/// Positions and radii of all bodies, one array per member, each with eight additional entries.
template <int D>
struct Members {
  std::array<std::vector<double>, D> x;  // m
  std::vector<double> radius;            // m
  double largest_radius = 0;             // m
};

/// Bodies of a cell, and ranges of bodies among which the partners of their pairs are searched.
template <int D>
struct Search {
  /// Partners in a row of cells along x.
  struct Part {
    Range bodies{};         // all partners, from left to right
    Range column{};         // those in the same column as the cell
    Horizontal<D> shift{};  // m, added to x and z of the partners
    Across<D> border{};     // m, y and (spheres) z of the cell's border towards the row
    Across<D> signs{};      // 1: the row is above that border, -1: below, 0: beside the cell
  };
  Range cell{};                // bodies of the cell
  double left = 0, right = 0;  // m, borders of the cell across x
  std::uint32_t end = 0;       // end of the partners (after the body) in the row of the cell
  /// Partners in other rows, and beyond the border of the strip; the first `count` are in use.
  std::array<Part, D == 2 ? 3 : 9> parts{};
  std::size_t count = 0;
  Horizontal<D> period{};  // m, of x and z if both images must be tried, else 0

  void add(const Part& part) { parts[count++] = part; }
};

/// Pairs in the order of their first body a: pairs begin[a] .. begin[a+1]-1, with second bodies b.
/// Pairs of spheres from far[a] on have a gap above near_part of the skin; pairs of discs are not
/// told apart.
struct FoundPairs {
  std::vector<std::uint32_t> begin, far, b;
  std::vector<std::uint32_t> scratch;  // of find_near()

  std::size_t size() const { return begin.empty() ? 0 : begin.back(); }
};

/// A pair of spheres is near if its gap was at most this part of the skin when the list was made.
/// Other pairs cannot touch before neighbouring groups have moved that far relative to each other;
/// until then they are not tested. From 0.35 to 0.65 the time of a step is the same within 3 %.
template <int D>
constexpr double near_part = D == 2 ? 1 : 0.5;

/// Appends to `found` the pairs whose gap is at most `skin`, m. The last entry of `found.begin`
/// must belong to the first body of the cell; `found.b` may have more entries than there are pairs.
template <int D>
void find_near(const Members<D>& members, const Search<D>& search, double skin, FoundPairs& found);

/// Memories of the pairs in an old list, and data that locate the same pairs in the new list.
template <int D>
struct CarryOver {
  const Pairs<D>& old;          // with indices of bodies before the sort
  const std::uint32_t* place;   // per old index of a body, its new index
  const FoundPairs& found;      // pairs of the new list
  const std::uint32_t* number;  // per pair in `found`, its entry in the new list
  Pairs<D>& pairs;              // new list
};

/// Copies the memories of old pairs first .. last-1 that have an impulse and are in the new list;
/// `first` and `last` are multiples of 8.
template <int D>
void carry_over(const CarryOver<D>& task, std::uint32_t first, std::uint32_t last);

}  // namespace grseg
