// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/contact/parallel.hpp"

#include <gtest/gtest.h>

#include <new>

namespace grseg {
namespace {

TEST(Parallel, AnExceptionInAThreadReachesTheCaller)
{
  const auto fifth_fails = [](std::size_t k) {
    if (k == 5) throw std::bad_alloc();
  };
  for (const int threads : {1, 3})
    EXPECT_THROW(for_each_part(threads, 8, fifth_fails), std::bad_alloc) << threads;
}

}  // namespace
}  // namespace grseg
