// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/balance/mean_of_windows.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {

MeanOfWindows mean_of_windows(const std::vector<double>& values)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = values.size();
  if (n == 0) return {nan, nan};
  const double mean = gsl_stats_mean(values.data(), 1, n);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (*most - *least <= 1e-6 * std::max(std::abs(*most), std::abs(*least))) return {mean, nan};
  return {mean, gsl_stats_sd_m(values.data(), 1, n, mean) / std::sqrt(static_cast<double>(n))};
}

std::string errors_over(const std::vector<double>& values)
{
  if (values.size() == 1) return "of one window";
  return std::isnan(mean_of_windows(values).error)
             ? fmt::format("of {} windows between which nothing moves, so that there are no errors",
                           values.size())
             : fmt::format("standard errors over {} windows", values.size());
}

}  // namespace grseg
