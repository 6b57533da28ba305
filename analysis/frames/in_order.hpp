// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>
#include <vector>

namespace grseg {

/// Calls work(k) for k = 0 .. count-1 on several threads, and take(result) with each result in the
/// order of k, one at a time. So the outcome does not depend on the number of threads. At any time
/// there are at most as many results as threads. The exception of the least k is thrown, as if all
/// calls were made one after the other.
template <class Work, class Take>
void in_order(int threads, std::size_t count, const Work& work, const Take& take)
{
  std::mutex turn;
  std::condition_variable taken;
  std::size_t next = 0, done = 0;  // the next k for `work`, and the next k for `take`
  std::exception_ptr trouble;
  const auto worker = [&] {
    std::unique_lock lock(turn);
    while (next < count && !trouble) {
      const std::size_t k = next++;
      lock.unlock();
      std::optional<std::invoke_result_t<Work, std::size_t>> result;
      std::exception_ptr wrong;
      try {
        result.emplace(work(k));
      } catch (...) {
        wrong = std::current_exception();
      }
      lock.lock();
      taken.wait(lock, [&] { return done == k; });
      try {
        if (!trouble && !wrong) take(*result);
      } catch (...) {
        wrong = std::current_exception();
      }
      if (!trouble) trouble = wrong;
      ++done;
      taken.notify_all();
    }
  };
  {
    // These threads sleep when they wait. OpenMP's would spin and slow the working threads down.
    std::vector<std::jthread> others(
        std::min(static_cast<std::size_t>(threads), std::max<std::size_t>(count, 1)) - 1);
    for (auto& other : others) other = std::jthread(worker);
    worker();
  }
  if (trouble) std::rethrow_exception(trouble);
}

}  // namespace grseg
