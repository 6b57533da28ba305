// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>

/// Loops shared among threads. Results must not depend on the order in which parts are done, so
/// that any number of threads produces the same bytes.
namespace grseg {

/// Calls do_part(k) for k = 0 .. count-1. Throws one of the exceptions that do_part throws.
template <class Part>
void for_each_part(int threads, std::size_t count, const Part& do_part)
{
  if (threads == 1 || count <= 1) {  // even a team of one thread costs microseconds
    for (std::size_t k = 0; k < count; ++k) do_part(k);
    return;
  }
  // An exception, such as bad_alloc, that leaves a parallel region would end the program.
  std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t k = 0; k < count; ++k) try {
      do_part(k);
    } catch (...) {
#pragma omp critical
      failure = std::current_exception();
    }
  if (failure) std::rethrow_exception(failure);
}

constexpr std::size_t range_size = 16384;
constexpr std::size_t range_count(std::size_t count)
{
  return (count + range_size - 1) / range_size;
}

/// Calls do_range(begin, end) for consecutive ranges of range_size indices that together are 0 ..
/// count-1; the last range may be shorter.
template <class Range>
void for_ranges(int threads, std::size_t count, const Range& do_range)
{
  for_each_part(threads, range_count(count), [&](std::size_t k) {
    do_range(k * range_size, std::min(count, (k + 1) * range_size));
  });
}

/// Calls do_strip(s) for all strips: first for even strips, several at a time, then for odd strips,
/// so that no two neighbouring strips are processed at the same time.
template <class Strip>
void for_alternate_strips(int threads, std::size_t count, const Strip& do_strip)
{
  for (const std::size_t odd : {0U, 1U})
    for_each_part(threads, (count + 1 - odd) / 2, [&](std::size_t k) { do_strip(2 * k + odd); });
}

}  // namespace grseg
