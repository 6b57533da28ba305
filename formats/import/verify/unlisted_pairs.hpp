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
  double gap = 0;             // distance of the surfaces over the smaller radius; negative: overlap
};

/// All pairs of present grains with a gap of at most `widest` and that `counts` is true of, in order of
/// i and j, across periods too; not pairs of which neither grain is mobile. Sizes may differ by any
/// factor.
std::vector<NearPair> near_pairs(const Grains& grains, const Box& box, const Frame<3>& frame,
                                 double widest, const std::function<bool(const NearPair&)>& counts);

/// The pairs that a list of contacts joins: rows of two grains, or of a grain and a wall, which has a
/// negative one.
class ListedPairs {
 public:
  using Pair = std::pair<std::int32_t, std::int32_t>;

  /// With `pushing_only`, only pairs that bear a force.
  explicit ListedPairs(const ContactList<3>& contacts, bool pushing_only = false);

  bool contains(std::int32_t i, std::int32_t j) const;
  /// A pair that the list has more than once.
  std::optional<Pair> twice() const;

 private:
  std::vector<std::size_t> begins_;  // of each grain in lower_, and the end
  std::vector<std::int32_t> lower_;  // the other rows of its pairs, lower than its own, sorted
};

/// Pairs that near_pairs() finds and the list of contacts of a moment leaves out.
struct UnlistedPairs {
  bool forces_grow = false;  // with the overlap, as in soft grains: then none may be unlisted
  /// Pairs without a row that overlap by more than the positions' errors, the deepest first.
  std::vector<NearPair> unlisted;
  std::size_t at_boundary = 0;  // of these, how many join a mobile grain and a boundary grain
  /// Pairs without a row that share their spin and move as one body with it. Where spins are 0:
  /// pairs of `unlisted` that move and keep their distance.
  std::vector<NearPair> rigid;
  double rigid_grains = 0;  // part of the mobile grains that belong to these

  double deepest() const { return unlisted.empty() ? 0 : -unlisted.front().gap; }
};

/// Compares the grains that overlap with the pairs that have a row. `error`: largest error of
/// distances from positions, over the smaller radius. A pair that overlaps by three times this, and
/// by a quarter of the median of the pairs with a row, must have one, too: larger errors of
/// positions would show as gaps of these.
UnlistedPairs unlisted_pairs_of(const Grains& grains, const Box& box, const Frame<3>& frame,
                                const ListedPairs& listed, double error);

}  // namespace grseg
