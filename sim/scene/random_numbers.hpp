// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <gsl/gsl_rng.h>

#include <cstdint>
#include <memory>

namespace grseg {

/// The random numbers of a seed (Mersenne twister), always the same.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed);

  double uniform();                   ///< in [0, 1)
  double gaussian(double deviation);  ///< of mean 0
  Vec2 direction();                   ///< a unit vector

 private:
  std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> generator_;
};

}  // namespace grseg
