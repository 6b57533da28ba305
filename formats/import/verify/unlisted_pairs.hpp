// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace grseg {

/// Two grains that overlap or nearly touch.
struct NearPair {
  std::int32_t i = 0, j = 0;  // rows of the grains, i < j
  double gap = 0;             // distance of surfaces over the smaller radius; negative: overlap
};

/// All pairs of present grains with a gap of at most `widest` for which `counts` returns true, in
/// order of i and j. Includes pairs across periodic boundaries; excludes pairs without a mobile
/// grain. Sizes may differ by any factor.
std::vector<NearPair> near_pairs(const Grains& grains, const Box& box, const Frame<3>& frame,
                                 double widest, const std::function<bool(const NearPair&)>& counts);

/// The pairs in a list of contacts: rows of two grains, or of a grain and a wall (negative).
class ListedPairs {
 public:
  using Pair = std::pair<std::int32_t, std::int32_t>;

  /// `pushing_only` leaves out pairs without a force.
  explicit ListedPairs(const ContactList<3>& contacts, bool pushing_only = false);

  bool contains(std::int32_t i, std::int32_t j) const;
  /// A pair that is more than once in the list; empty if there is none.
  std::optional<Pair> twice() const;

 private:
  std::vector<std::size_t> begins_;  // index in lower_ of each grain's first pair, and the end
  std::vector<std::int32_t> lower_;  // smaller row of each pair, sorted, by grain of the larger row
};

/// Pairs of near grains that are not in the list of contacts of a frame.
struct UnlistedPairs {
  /// True if forces grow with overlaps, as in soft grains: all overlapping pairs must be listed.
  bool forces_grow = false;
  /// Pairs without a row that overlap by more than the positions' errors, the deepest first.
  std::vector<NearPair> unlisted;
  std::size_t at_boundary = 0;  // number of `unlisted` pairs with a boundary grain
  /// Pairs without a row that move as one rigid body, with equal angular velocities. If these are
  /// 0: pairs of `unlisted` that move at constant distance.
  std::vector<NearPair> rigid;

  double deepest() const { return unlisted.empty() ? 0 : -unlisted.front().gap; }
};

/// Compares overlapping grains with the pairs that have a row. `error` is the largest error of
/// distances from positions, over the smaller radius. A pair must have a row if it overlaps by more
/// than three times this error, and by more than a quarter of the median overlap of the listed
/// pairs. (Larger errors of positions would be visible as gaps of listed pairs.)
UnlistedPairs unlisted_pairs_of(const Grains& grains, const Box& box, const Frame<3>& frame,
                                const ListedPairs& listed, double error);

}  // namespace grseg
