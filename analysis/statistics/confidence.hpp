// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/sums.hpp"

#include <Eigen/Core>
#include <vector>

namespace grseg {

/// A number with its 95 % interval; NaN where it cannot be told.
struct Estimate {
  double value = no_number;
  double low = no_number;
  double high = no_number;
};

/// Degrees of freedom below which there is no interval.
inline constexpr double least_degrees = 0.5;

/// Standard error and the degrees of freedom it is known with.
struct StandardError {
  double error = 0, degrees = 0;

  /// Student's 97.5 % quantile times the error; NaN below least_degrees.
  double reach() const;
  /// value -+ reach(); of a value that is not finite there is no interval.
  Estimate around(double value) const;
};

/// A number with its standard error; NaN and 0 degrees where it is not known.
struct Measured {
  double value = no_number;
  StandardError error{no_number, 0};

  Estimate estimate() const { return error.around(value); }
};

/// Of a statistic whose deviation is the sum of `influence`, one entry per observation of one run
/// in order of time, where `fitted` parameters were taken from the same n observations:
///   error^2 = tau sum influence^2 / (1 - fitted tau/n),  degrees = n/tau - fitted,
/// tau the integrated autocorrelation time of the influence (dependence.hpp). NaN and 0 degrees below
/// least_degrees.
StandardError standard_error(const Eigen::VectorXd& influence, int fitted);

/// Likewise, of observations that are independent but for a slow change, which is no error: from
/// their successive differences (von Neumann 1941), error^2 = n/(n - 1) sum (difference)^2/2 with
/// 2 (n - 1)/3 degrees of freedom.
StandardError error_about_trend(const Eigen::VectorXd& influence);

/// Errors from whole runs: each is one observation, whatever goes on inside it.

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
