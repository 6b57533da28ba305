// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/sums.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace grseg {

/// A number with its 95 % interval; NaN if it is not known.
struct Estimate {
  double value = no_number;
  double low = no_number;
  double high = no_number;
};

/// Degrees of freedom below which there is no interval.
inline constexpr double least_degrees = 0.5;

/// Standard error and its degrees of freedom.
struct StandardError {
  double error = 0, degrees = 0;

  /// Student's 97.5 % quantile times the error; NaN below least_degrees.
  double reach() const;
  /// The interval value -+ reach(); NaN bounds for a value that is not finite.
  Estimate around(double value) const;
};

/// A number with its standard error; NaN and 0 degrees if they are not known.
struct Measured {
  double value = no_number;
  StandardError error{no_number, 0};

  Estimate estimate() const { return error.around(value); }
};

/// Error of a statistic whose observations scatter independently about a slow trend. Successive
/// differences (von Neumann 1941) leave the trend out: error^2 = n/(n - 1) sum (difference)^2/2
/// with 2 (n - 1)/3 degrees of freedom.
StandardError error_about_trend(const Eigen::VectorXd& influence);

/// Independent parts of the deviation of a statistic from its expectation. The sum of their squares
/// estimates the variance of the statistic, and their products its covariance with another one.
struct Deviation {
  Eigen::VectorXd parts;
  double degrees = 0;

  StandardError error() const { return {degrees > 0 ? parts.norm() : no_number, degrees}; }
};

/// Number of equally weighted terms that terms of these weights are worth: (sum w)^2/sum w^2.
double effective_number(const Eigen::VectorXd& weight);

/// Deviation of a statistic by how runs differ: `influence` has one entry per run of a mixture. If
/// runs were equal, influences would be in proportion to the `weight` W; e is the difference from
/// this. With runs worth m = (sum W)^2/sum W^2 runs of equal weight,
///   error^2 = m/(m - 1) sum e^2,  e = influence - (sum influence) W/sum W,  degrees = m - 1.
/// No parts for a single run.
Deviation deviation_of_runs(const Eigen::VectorXd& influence, const Eigen::VectorXd& weight);

/// Error of a sum of independent parts: error^2 = sum error_k^2, with degrees by Satterthwaite
/// (1946) from unbiased fourth powers, which matters if parts have one degree each (Welch 1947):
///   degrees = error^4/sum(error_k^4/(degrees_k + 2)) - 2,
/// but at least the smallest degrees of a part and at most their sum. NaN if one part is unknown.
StandardError added(const std::vector<StandardError>& parts);

/// Index of a window in a vector of Eigen.
inline Eigen::Index index(std::size_t window)
{
  return static_cast<Eigen::Index>(window);
}

/// Results of `of`, a function or a member, for each element of a list.
template <class List, class Of>
Eigen::VectorXd numbers_of(const List& list, const Of& of)
{
  Eigen::VectorXd numbers(index(list.size()));
  Eigen::Index place = 0;
  for (const auto& one : list) numbers[place++] = std::invoke(of, one);
  return numbers;
}

/// A warning if an interval over runs is wide because runs are few; `weight` is of the runs.
std::string doubt_of_runs(const Eigen::VectorXd& weight);

}  // namespace grseg
