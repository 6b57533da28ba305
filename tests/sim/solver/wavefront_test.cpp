// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/solver/wavefront.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace grseg {
namespace {

/// Strips whose numbers are computed from those of their neighbours, so that any other order gives
/// different numbers.
struct Ring {
  std::vector<std::uint64_t> number, closed;

  explicit Ring(std::size_t strips) : number(strips), closed(strips)
  {
    for (std::size_t s = 0; s < strips; ++s) number[s] = closed[s] = s + 1;
  }
  /// Strips 0 and last of a row with an odd number of strips are no neighbours.
  std::uint64_t neighbours(std::size_t s, const std::vector<std::uint64_t>& of) const
  {
    const std::size_t strips = of.size();
    std::uint64_t mixed = 0;
    if (s > 0 || strips % 2 == 0) mixed = 31 * of[(s + strips - 1) % strips];
    if (s + 1 < strips || strips % 2 == 0) mixed += 37 * of[(s + 1) % strips];
    return strips > 1 ? mixed : 0;
  }
  void work(std::size_t s, std::size_t round)
  {
    number[s] =
        1000003 * (number[s] + neighbours(s, number) + closed[s] + round) + neighbours(s, closed);
  }
  void close(std::size_t s) { closed[s] = 998244353 * number[s] + neighbours(s, number); }
};

TEST(Wavefront, EveryStripSeesWhatRoundAfterRoundShowsIt)
{
  for (const std::size_t strips : {1U, 2U, 3U, 4U, 5U, 8U, 9U, 40U}) {
    for (const std::size_t rounds : {1U, 2U, 4U, 9U}) {
      Ring expected(strips);
      for (std::size_t round = 0; round < rounds; ++round) {
        for (const std::size_t odd : {0U, 1U})
          for (std::size_t s = odd; s < strips; s += 2) expected.work(s, round);
        for (std::size_t s = 0; s < strips; ++s) expected.close(s);
      }
      for (const int threads : {1, 2, 3, 8}) {
        Ring ring(strips);
        Wavefront(strips, static_cast<int>(rounds))
            .run(
                threads, [&](std::size_t s, std::size_t round) { ring.work(s, round); },
                [&](std::size_t s, std::size_t) { ring.close(s); });
        EXPECT_EQ(ring.number, expected.number) << strips << " " << rounds << " " << threads;
        EXPECT_EQ(ring.closed, expected.closed) << strips << " " << rounds << " " << threads;
      }
    }
  }
}

TEST(Wavefront, AStripIsWorkedOnAgainWhileTheCacheStillHoldsIt)
{
  // A strip can be swept again when it and its neighbours are closed, i.e. after the strip after next
  // has been swept, two strips later. Where the ring closes, the last strips wait for the first.
  // wait for the first.
  constexpr std::size_t strips = 100;
  constexpr int rounds = 4;
  std::vector<std::size_t> order;
  Wavefront(strips, rounds)
      .run(
          1, [&](std::size_t s, std::size_t) { order.push_back(s); },
          [](std::size_t, std::size_t) {});
  ASSERT_EQ(order.size(), strips * rounds);
  std::vector<std::size_t> last(strips, order.size());
  std::size_t soon = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    soon += k - std::min(k, last[order[k]]) <= 4 * rounds && last[order[k]] < k;
    last[order[k]] = k;
  }
  EXPECT_GT(soon, (strips - 4 * rounds) * (rounds - 1));
}

}  // namespace
}  // namespace grseg
