// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <gsl/gsl_rng.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace grseg {

/// Random numbers (Mersenne twister): the same for a seed on every machine.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) { gsl_rng_set(generator_.get(), seed); }

  /// Uniform random number in [0, 1).
  double uniform() { return gsl_rng_uniform(generator_.get()); }

  // The following functions repeat gsl_ran_gaussian and gsl_ran_dir_2d operation by operation. They
  // are compiled here, without contraction of products and sums, because GSL on Arm rounds
  // differently.

  /// Normal random number of mean 0 and standard deviation `deviation`.
  double gaussian(double deviation)
  {
    double y = 0, squared = 0;
    do {
      const double x = -1 + 2 * gsl_rng_uniform_pos(generator_.get());
      y = -1 + 2 * gsl_rng_uniform_pos(generator_.get());
      squared = x * x + y * y;
    } while (squared > 1 || squared == 0);
    return deviation * y * std::sqrt(-2 * std::log(squared) / squared);
  }

  /// Random unit vector.
  template <int D>
  Vector<D> direction()
  {
    double x = 0, y = 0, squared = 0;
    do {
      x = -1 + 2 * uniform();
      y = -1 + 2 * uniform();
      squared = x * x + y * y;
    } while (squared > 1 || squared == 0);
    if constexpr (D == 2) {
      return {(x * x - y * y) / squared, 2 * x * y / squared};
    } else {  // Marsaglia, Ann. Math. Stat. 43, 645 (1972)
      const double factor = 2 * std::sqrt(1 - squared);
      return {factor * x, factor * y, 1 - 2 * squared};
    }
  }

  /// Puts `items` into random order.
  template <class T>
  void shuffle(std::vector<T>& items)
  {
    for (auto left = items.size(); left > 1; --left)
      std::swap(items[left - 1],
                items[static_cast<std::size_t>(uniform() * static_cast<double>(left))]);
  }

 private:
  std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> generator_{gsl_rng_alloc(gsl_rng_mt19937),
                                                               gsl_rng_free};
};

}  // namespace grseg
