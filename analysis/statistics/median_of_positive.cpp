// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/median_of_positive.hpp"

#include <gsl/gsl_statistics.h>

namespace grseg {

double median_of_positive(std::vector<double> values)
{
  std::erase_if(values, [](double value) { return !(value > 0); });
  return values.empty() ? 0 : gsl_stats_median(values.data(), 1, values.size());
}

}  // namespace grseg
