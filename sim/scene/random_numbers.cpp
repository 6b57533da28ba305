// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/random_numbers.hpp"

#include <gsl/gsl_randist.h>

namespace grseg {

RandomNumbers::RandomNumbers(std::uint64_t seed)
    : generator_(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free)
{
  gsl_rng_set(generator_.get(), seed);
}

double RandomNumbers::uniform()
{
  return gsl_rng_uniform(generator_.get());
}

double RandomNumbers::gaussian(double deviation)
{
  return gsl_ran_gaussian(generator_.get(), deviation);
}

Vec2 RandomNumbers::direction()
{
  Vec2 unit;
  gsl_ran_dir_2d(generator_.get(), &unit.x(), &unit.y());
  return unit;
}

}  // namespace grseg
