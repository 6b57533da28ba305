// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstdint>
#include <functional>
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
template <int D>
std::vector<NearPair> near_pairs(const Grains& grains, const Box& box, const Frame<D>& frame,
                                 double widest, const std::function<bool(const NearPair&)>& counts);

}  // namespace grseg
