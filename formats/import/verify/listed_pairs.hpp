// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace grseg {

/// The pairs that a list of contacts joins: rows of two grains, or of a grain and a wall, which has a
/// negative one.
class ListedPairs {
 public:
  using Pair = std::pair<std::int32_t, std::int32_t>;

  /// With `pushing_only`, those that bear a force.
  template <int D>
  explicit ListedPairs(const ContactList<D>& contacts, bool pushing_only = false);

  bool contains(std::int32_t i, std::int32_t j) const;
  /// A pair that the list has more than once.
  std::optional<Pair> twice() const;

 private:
  std::vector<std::size_t> begins_;  // of each grain in lower_, and the end
  std::vector<std::int32_t> lower_;  // the other rows of its pairs, lower than its own, sorted
};

}  // namespace grseg
