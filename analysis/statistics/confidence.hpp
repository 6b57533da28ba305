// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>

namespace grseg {

/// A number with its 95 % interval; NaN where it cannot be told.
struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// A 95 % interval alone.
struct Interval {
  double low, high;
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
  Interval interval_around(double value) const;
};

/// A number with its standard error; NaN and 0 degrees where it is not known.
struct Measured {
  double value = std::numeric_limits<double>::quiet_NaN();
  StandardError error{std::numeric_limits<double>::quiet_NaN(), 0};

  Estimate estimate() const { return error.around(value); }
  Interval interval() const { return error.interval_around(value); }
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

}  // namespace grseg
