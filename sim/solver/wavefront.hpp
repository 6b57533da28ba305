// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

namespace grseg {

/// Rounds of work on strips in a ring. In a round a strip is first worked on, those of even number
/// before their odd neighbours, and is closed when its neighbours have been worked on, too. The next
/// round may work on it when it and its neighbours are closed. Instead of making round after round, the
/// strips that were last worked on go ahead as far as their neighbours allow, while the cache still
/// holds them; what each does and sees is the same, and so is every byte, with any number of threads.
class Wavefront {
 public:
  Wavefront(std::size_t strips, int rounds) : worked_(strips), closed_(strips), rounds_(rounds) {}

  /// What is done with a strip in a round; rounds count from 0.
  using Task = std::function<void(std::size_t strip, std::size_t round)>;
  /// Calls both once for each strip and round.
  void run(int threads, const Task& work, const Task& close);

 private:
  using Counts = std::vector<std::atomic<int>>;  // rounds done, per strip

  void run_between(std::size_t begin, std::size_t end, const Task& work, const Task& close);
  bool go_ahead(std::size_t strip, const Task& work, const Task& close);
  static bool neighbours_have(const Counts& counts, std::size_t strip, int rounds);

  Counts worked_, closed_;
  int rounds_;
};

}  // namespace grseg
