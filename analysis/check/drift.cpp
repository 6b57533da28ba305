// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/drift.hpp"

#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace grseg {

Drift change_over(const std::vector<double>& times, const std::vector<double>& values)
{
  double constant = 0, slope = 0, c00 = 0, c01 = 0, c11 = 0, squares = 0;
  gsl_fit_linear(times.data(), 1, values.data(), 1, times.size(), &constant, &slope, &c00, &c01,
                 &c11, &squares);
  const double span = times.back() - times.front();
  return {slope * span, std::sqrt(std::max(0.0, c11)) * span};
}

Drift mean_of(const std::vector<double>& values)
{
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (n * (n - 1)))};
}

WindowMeans::WindowMeans(const std::vector<RunningSums>& windows)
{
  const auto mean = [](double sum, double count) { return count > 0 ? sum / count : 0; };
  for (std::size_t k = 0; k + 1 < windows.size(); ++k) {
    const auto &a = windows[k], &b = windows[k + 1];
    time.push_back((a.time + b.time) / 2);
    overlap.push_back(mean(b.overlap - a.overlap, b.overlaps - a.overlaps));
    energy_defect.push_back(mean(b.energy_defect - a.energy_defect, b.frames - a.frames));
    stray_rate.push_back((b.stray - a.stray) / (b.time - a.time));
    stray_rate_across.push_back((b.stray_across - a.stray_across) / (b.time - a.time));
  }
}

}  // namespace grseg
