// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/wavefront.hpp"

#include <omp.h>

#include <thread>

namespace grseg {

void Wavefront::run(int threads, const Action& work, const Action& finish)
{
  const std::size_t strips = finished_.size();
#pragma omp parallel num_threads(threads) if (threads > 1)
  {
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    const auto team = static_cast<std::size_t>(omp_get_num_threads());
    run_between(strips * thread / team, strips * (thread + 1) / team, work, finish);
  }
}

/// Runs the part of one thread: strips begin .. end-1.
void Wavefront::run_between(std::size_t begin, std::size_t end, const Action& work,
                            const Action& finish)
{
  for (std::size_t s = begin, through = 0; through < end - begin;) {
    if (go_ahead(s, work, finish)) {
      if (finished_[s] == rounds_) ++through;
      if (s > begin) --s;  // strip s - 1 may have waited for strip s
    } else if (++s == end) {
      s = begin;
      std::this_thread::yield();  // strips of other threads must advance first
    }
  }
}

bool Wavefront::go_ahead(std::size_t strip, const Action& work, const Action& finish)
{
  const int round = finished_[strip].load(std::memory_order_relaxed);
  if (round == rounds_) return false;
  if (worked_[strip].load(std::memory_order_relaxed) == round) {
    const bool even = strip % 2 == 0;
    if (!neighbours_have(even ? finished_ : worked_, strip, even ? round : round + 1)) return false;
    work(strip, static_cast<std::size_t>(round));
    worked_[strip].store(round + 1, std::memory_order_release);
    return true;
  }
  if (!neighbours_have(worked_, strip, round + 1)) return false;
  finish(strip, static_cast<std::size_t>(round));
  finished_[strip].store(round + 1, std::memory_order_release);
  return true;
}

/// True if both neighbours of a strip have done `rounds` rounds. First and last strip count as
/// neighbours, which a row of strips does not need.
bool Wavefront::neighbours_have(const Counts& counts, std::size_t strip, int rounds)
{
  const std::size_t last = counts.size() - 1;
  for (const auto other : {strip == 0 ? last : strip - 1, strip == last ? 0 : strip + 1})
    if (counts[other].load(std::memory_order_acquire) < rounds) return false;
  return true;
}

}  // namespace grseg
