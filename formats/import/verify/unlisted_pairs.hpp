// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/verify/listed_pairs.hpp"
#include "formats/import/verify/near_pairs.hpp"

#include <cstddef>
#include <vector>

namespace grseg {

/// What the list of contacts of a moment leaves out. Pairs are those near_pairs() finds.
struct UnlistedPairs {
  bool forces_grow = false;  // with the overlap, as those of soft grains: then none may be unlisted
  /// Pairs without a row that overlap by more than the positions' errors, the deepest first.
  std::vector<NearPair> unlisted;
  std::size_t at_boundary = 0;  // of these, how many join a mobile grain and a boundary grain
  /// Pairs without a row that share their spin and move as one body with it. Where spins are 0: those
  /// of `unlisted` that move and keep their distance.
  std::vector<NearPair> rigid;
  double rigid_grains = 0;  // part of the mobile grains that belong to these

  double deepest() const { return unlisted.empty() ? 0 : -unlisted.front().gap; }
};

/// Compares the grains that overlap with those that have a row. `error`: by how much distances from
/// positions may be wrong, over the smaller radius. What overlaps by three times this, and by a
/// quarter of the median of the pairs with a row, must have one, too: larger errors of positions
/// would show as gaps of these.
template <int D>
UnlistedPairs unlisted_pairs_of(const Grains& grains, const Box& box, const Frame<D>& frame,
                                const ListedPairs& listed, double error);

}  // namespace grseg
