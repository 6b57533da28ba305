// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/statistics/confidence.hpp"

#include <Eigen/Core>
#include <vector>

/// Errors from whole runs: each is one observation, whatever goes on inside it.
namespace grseg {

/// Of a statistic whose deviation is the sum of `influence`, one entry per run of one mixture, about
/// what the run would add if it were like its mixture, which goes by `weight`: with R runs worth
/// m = (sum W)^2/sum W^2 of equal weight,
///   error^2 = m/(m - 1) sum e^2,  e = influence - (sum influence) W/sum W,  degrees = m - 1.
/// NaN and 0 degrees for a single run.
StandardError scatter_of_runs(const Eigen::VectorXd& influence, const Eigen::VectorXd& weight);

/// Of a sum of independent parts: error^2 = sum of theirs, degrees by Satterthwaite (1946) with the
/// fourth powers freed of their bias, which matters where parts have one degree each (Welch 1947):
///   degrees = error^4/sum(error_k^4/(degrees_k + 2)) - 2,
/// not less than the least of the parts nor more than their sum. NaN where one part is unknown.
StandardError added(const std::vector<StandardError>& parts);

/// Of the unweighted mean of values that were drawn independently (Student 1908); n - 1 degrees.
StandardError scatter_of_values(const Eigen::VectorXd& values);

/// The unweighted mean of independent numbers: its error by theirs (`added`), the numbers being these
/// very ones, and by their scatter (`scatter_of_values`), these being drawn from all.
struct MeanOfEquals {
  double value;
  StandardError by_errors, by_scatter;
};
MeanOfEquals mean_of_equals(const std::vector<Measured>& numbers);

}  // namespace grseg
