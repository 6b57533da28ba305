// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

namespace grseg {

/// Rounds of work on strips in a row or, if their number is even, a ring. In a round a strip is
/// first worked on, even strips before their odd neighbours, and is finished when its neighbours
/// have been worked on, too. The next round may work on it when it and its neighbours are finished.
/// Rather than finish one round before the next begins, a thread takes its last strips as far as
/// their neighbours allow, while they are in the cache. Each strip does and sees the same, so
/// results are the same to the byte with any number of threads.
class Wavefront {
 public:
  /// `rounds` is at least 1.
  Wavefront(std::size_t strips, int rounds) : worked_(strips), finished_(strips), rounds_(rounds) {}

  /// Work on a strip in a round; rounds count from 0.
  using Action = std::function<void(std::size_t strip, std::size_t round)>;
  /// Calls both once for each strip and round.
  void run(int threads, const Action& work, const Action& finish);

 private:
  using Counts = std::vector<std::atomic<int>>;  // rounds done, per strip

  void run_between(std::size_t begin, std::size_t end, const Action& work, const Action& finish);
  bool go_ahead(std::size_t strip, const Action& work, const Action& finish);
  static bool neighbours_have(const Counts& counts, std::size_t strip, int rounds);

  Counts worked_, finished_;
  int rounds_;
};

}  // namespace grseg
