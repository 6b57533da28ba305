// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/frames/in_order.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace grseg {
namespace {

using namespace std::chrono_literals;

/// Waits, longer for smaller k, so that work that starts first ends last.
void dawdle(std::size_t k)
{
  std::this_thread::sleep_for((3 - k % 4) * 300us);
}

TEST(InOrder, ResultsAreTakenInOrderWhoeverIsFirst)
{
  for (const int threads : {1, 2, 3, 7, 40}) {
    std::vector<std::size_t> taken;
    in_order(
        threads, 20,
        [](std::size_t k) {
          dawdle(k);
          return k;
        },
        [&](std::size_t k) { taken.push_back(k); });
    std::vector<std::size_t> all(20);
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(taken, all) << threads;
  }
}

TEST(InOrder, NoWorkIsAllowed)
{
  in_order(
      3, 0, [](std::size_t k) { return k; }, [](std::size_t) { FAIL(); });
}

/// Counts how many objects of this type exist.
struct Counted {
  static std::atomic<int> alive, most;
  Counted()
  {
    const int now = ++alive;
    for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
    }
  }
  Counted(Counted&&) noexcept { ++alive; }
  Counted(const Counted&) = delete;
  ~Counted() { --alive; }
};
std::atomic<int> Counted::alive = 0, Counted::most = 0;

// A thread whose result waits for its turn waits, too, however slow the first work is.
TEST(InOrder, AtMostAsManyResultsAsThreadsAreStored)
{
  Counted::most = 0;
  in_order(
      3, 30,
      [](std::size_t k) {
        Counted result;
        std::this_thread::sleep_for(k == 0 ? 20ms : 0ms);
        return result;
      },
      [](const Counted&) {});
  EXPECT_EQ(Counted::alive, 0);
  EXPECT_GE(Counted::most, 2);
  EXPECT_LE(Counted::most, 3);
}

/// Message of the exception that in_order() throws.
template <class Work, class Take>
std::string trouble(int threads, const Work& work, const Take& take)
{
  try {
    in_order(threads, 40, work, take);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(InOrder, TheFirstErrorIsThrownAndNoLaterResultIsUsed)
{
  for (const int threads : {1, 2, 3, 7, 40}) {
    std::vector<std::size_t> taken;
    const auto work = [&](std::size_t k) {
      if (k == 5) std::this_thread::sleep_for(5ms);
      if (k == 5 || k > 10) throw std::runtime_error(std::to_string(k));
      return k;
    };
    EXPECT_EQ(trouble(threads, work, [&](std::size_t k) { taken.push_back(k); }), "5");
    EXPECT_EQ(taken, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  }
}

TEST(InOrder, AnErrorInTheUseOfAResultIsThrownToo)
{
  const auto take = [](std::size_t k) {
    if (k >= 3) throw std::runtime_error(std::to_string(k));
  };
  for (const int threads : {1, 3})
    EXPECT_EQ(trouble(
                  threads, [](std::size_t k) { return k; }, take),
              "3");
}

}  // namespace
}  // namespace grseg
