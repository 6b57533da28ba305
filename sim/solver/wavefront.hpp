// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

namespace grseg {

/// Order of work on strips that form a row or, if their number is even, a ring. In each round two
/// actions are called per strip: `work`, for even strips before their odd neighbours, and `finish`,
/// after `work` on the strip and its neighbours. The next round of a strip begins when the strip
/// and its neighbours are finished. A thread does not wait for the end of a round: it continues
/// with its last strips, which are still in the cache, as far as their neighbours allow. The order
/// of actions on a strip and its neighbours is fixed, so results do not depend on threads.
class Wavefront {
 public:
  /// `rounds` is at least 1.
  Wavefront(std::size_t strips, int rounds) : worked_(strips), finished_(strips), rounds_(rounds) {}

  /// Action on a strip in a round; rounds are numbered from 0.
  using Action = std::function<void(std::size_t strip, std::size_t round)>;
  /// Calls `work` and `finish` once for each strip and round.
  void run(int threads, const Action& work, const Action& finish);

 private:
  using Counts = std::vector<std::atomic<int>>;  // number of rounds done, per strip

  void run_between(std::size_t begin, std::size_t end, const Action& work, const Action& finish);
  bool go_ahead(std::size_t strip, const Action& work, const Action& finish);
  static bool neighbours_have(const Counts& counts, std::size_t strip, int rounds);

  Counts worked_, finished_;
  int rounds_;
};

}  // namespace grseg
