// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/mean_of_windows.hpp"

#include <gsl/gsl_statistics.h>

#include <cmath>
#include <limits>

namespace grseg {

MeanOfWindows mean_of_windows(const std::vector<double>& values)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = values.size();
  if (n == 0) return {nan, nan};
  const double mean = gsl_stats_mean(values.data(), 1, n);
  if (n == 1) return {mean, nan};
  return {mean, gsl_stats_sd_m(values.data(), 1, n, mean) / std::sqrt(static_cast<double>(n))};
}

}  // namespace grseg
