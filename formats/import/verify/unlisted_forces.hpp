// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/verify/imbalance.hpp"

#include <string>

namespace grseg {

/// Which forces that the archive does not list would balance its grains, as part of a sentence; ""
/// where none of these would: forces along pairs that bear none in the list, opposite on the two grains (bonds,
/// or contacts that pull beyond touch); a drag on each grain, in proportion to its velocity or its
/// momentum.
struct UnlistedForces {
  std::string sentence;
  bool acts_as_weight = false;  // gravity found from the grains would be wrong by them
};

template <int D>
UnlistedForces unlisted_forces(const Grains& grains, const Box& box, const Frame<D>& frame,
                               const Imbalance<D>& imbalance);

}  // namespace grseg
