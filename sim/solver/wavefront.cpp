// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/wavefront.hpp"

#include <omp.h>

#include <thread>

namespace grseg {

void Wavefront::run(int threads, const Task& work, const Task& close)
{
  const std::size_t strips = closed_.size();
#pragma omp parallel num_threads(threads) if (threads > 1)
  {
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    const auto team = static_cast<std::size_t>(omp_get_num_threads());
    run_between(strips * thread / team, strips * (thread + 1) / team, work, close);
  }
}

/// What a thread does.
void Wavefront::run_between(std::size_t begin, std::size_t end, const Task& work, const Task& close)
{
  for (std::size_t s = begin, finished = 0; finished < end - begin;) {
    if (go_ahead(s, work, close)) {
      if (closed_[s] == rounds_) ++finished;
      s = s < begin + 2 ? begin : s - 2;  // may have waited for this one
    } else if (++s == end) {
      s = begin;
      std::this_thread::yield();  // others have to go ahead first
    }
  }
}

bool Wavefront::go_ahead(std::size_t strip, const Task& work, const Task& close)
{
  const int round = closed_[strip].load(std::memory_order_relaxed);
  if (round == rounds_) return false;
  if (worked_[strip].load(std::memory_order_relaxed) == round) {
    if (!neighbours_have(closed_, strip, round)) return false;
    if (strip % 2 == 1 && !neighbours_have(worked_, strip, round + 1)) return false;
    work(strip, static_cast<std::size_t>(round));
    worked_[strip].store(round + 1, std::memory_order_release);
    return true;
  }
  if (!neighbours_have(worked_, strip, round + 1)) return false;
  close(strip, static_cast<std::size_t>(round));
  closed_[strip].store(round + 1, std::memory_order_release);
  return true;
}

/// The first and the last strip may both be even: then they are no neighbours, because the row does
/// not close to a ring.
bool Wavefront::neighbours_have(const Counts& counts, std::size_t strip, int rounds)
{
  const std::size_t last = counts.size() - 1;
  for (const auto other : {strip == 0 ? last : strip - 1, strip == last ? 0 : strip + 1})
    if (other % 2 != strip % 2 && counts[other].load(std::memory_order_acquire) < rounds)
      return false;
  return true;
}

}  // namespace grseg
