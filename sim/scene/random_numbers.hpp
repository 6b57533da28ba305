// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <gsl/gsl_rng.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace grseg {

/// The random numbers of a seed (Mersenne twister), always the same.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed);

  double uniform();                   ///< in [0, 1)
  double gaussian(double deviation);  ///< of mean 0
  Vec2 direction();                   ///< a unit vector

  /// Puts `items` into random order.
  template <class T>
  void shuffle(std::vector<T>& items)
  {
    for (auto left = items.size(); left > 1; --left)
      std::swap(items[left - 1],
                items[static_cast<std::size_t>(uniform() * static_cast<double>(left))]);
  }

 private:
  std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> generator_;
};

}  // namespace grseg
