// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace grseg {

/// A value and its standard error.
struct Drift {
  double value, error;
};

/// Slope of the least-squares line through `values`, times the time it is taken over.
Drift change_over(const std::vector<double>& times, const std::vector<double>& values);
/// Mean of independent values.
Drift mean_of(const std::vector<double>& values);

/// Sums over the frames before the first one of a window.
struct RunningSums {
  double time = 0;                     // s
  double stray = 0, stray_across = 0;  // m, MotionBalance::stray along x and z
  double overlap = 0, overlaps = 0;    // m, and the number of pairs
  double energy_defect = 0, frames = 0;
};

/// Means of the windows, from the sums at the beginning of each; the last window only ends the one
/// before it.
struct WindowMeans {
  std::vector<double> time;     // s, middle
  std::vector<double> overlap;  // m
  std::vector<double> energy_defect;
  std::vector<double> stray_rate, stray_rate_across;  // m/s

  explicit WindowMeans(const std::vector<RunningSums>& windows);
};

}  // namespace grseg
