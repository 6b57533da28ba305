// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/sums.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <functional>
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

/// Error of a statistic that deviates from its expectation by the sum of `influence`, one entry per
/// observation of a run, in order of time. `fitted` parameters were fitted to these n observations:
///   error^2 = tau sum influence^2 / (1 - fitted tau/n),  degrees = n/tau - fitted,
/// with tau the integrated autocorrelation time of the influence (autocorrelation_time). NaN and 0
/// degrees below least_degrees.
StandardError standard_error(const Eigen::VectorXd& influence, int fitted);

/// Error of a statistic whose observations scatter independently about a slow trend. Successive
/// differences (von Neumann 1941) leave the trend out: error^2 = n/(n - 1) sum (difference)^2/2
/// with 2 (n - 1)/3 degrees of freedom.
StandardError error_about_trend(const Eigen::VectorXd& influence);

/// Errors from whole runs, each of which is one observation.

/// Error of a statistic that deviates from its expectation by the sum of `influence`, one entry per
/// run of a mixture. If runs were equal, influences would be in proportion to the `weight` W; e is
/// the difference from this. With runs worth m = (sum W)^2/sum W^2 runs of equal weight,
///   error^2 = m/(m - 1) sum e^2,  e = influence - (sum influence) W/sum W,  degrees = m - 1.
/// NaN and 0 degrees for a single run.
StandardError scatter_of_runs(const Eigen::VectorXd& influence, const Eigen::VectorXd& weight);

/// Error of a sum of independent parts: error^2 = sum error_k^2, with degrees by Satterthwaite
/// (1946) from unbiased fourth powers, which matters if parts have one degree each (Welch 1947):
///   degrees = error^4/sum(error_k^4/(degrees_k + 2)) - 2,
/// but at least the smallest degrees of a part and at most their sum. NaN if one part is unknown.
StandardError added(const std::vector<StandardError>& parts);

/// Error of the unweighted mean of independent values (Student 1908), with n - 1 degrees.
StandardError scatter_of_values(const Eigen::VectorXd& values);

/// Unweighted mean of independent numbers with two errors. `by_errors` follows from the numbers'
/// errors (added) and is valid for the mean of just these numbers. `by_scatter` follows from their
/// differences (scatter_of_values) and is valid for the population from which they were drawn.
struct MeanOfEquals {
  double value;
  StandardError by_errors, by_scatter;
};
MeanOfEquals mean_of_equals(const std::vector<Measured>& numbers);

/// Number of windows of each run. A series has the windows of all runs, one run after the other.
using RunLengths = std::vector<std::size_t>;
std::size_t number_of_windows(const RunLengths& runs);

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

/// Correlation between the windows of a series, and effective numbers of windows and runs.
struct Dependence {
  double time = 1;               // integrated autocorrelation time in windows, at least 1
  std::size_t block = 1;         // number of consecutive windows that are drawn together
  double effective_windows = 0;  // (sum b)^2 / sum b^2 for the windows' weights b
  double effective_runs = 0;     // (sum b)^2 / sum b^2 for the runs' weights b

  double independent_windows() const { return effective_windows / time; }
};

/// Integrated autocorrelation time in windows, 1 + 2 sum of the autocorrelation function of all
/// runs, each about its own mean. It is the largest of 1 and two estimates: the sum to the first
/// lag >= 5 times the result (Madras & Sokal 1988), corrected for the subtracted mean (Wolff 2004);
/// and (1 + rho)/(1 - rho), rho being the neighbours' correlation without its bias (Kendall 1954).
double autocorrelation_time(const Eigen::VectorXd& series, const RunLengths& runs);

/// Correlation rho of neighbours in an AR(1) series with autocorrelation time (1 + rho)/(1 - rho).
double neighbour_correlation(double time);

/// Length of blocks, in windows, with the least error of the variance for an AR(1) series of the
/// same autocorrelation time tau: (sqrt(6) rho/(1 - rho^2))^(2/3) n^(1/3), rho = (tau - 1)/(tau +
/// 1), n windows per run (Carlstein 1986). At least 1, and so short that blocks outnumber runs.
std::size_t block_length(double time, const RunLengths& runs);

/// Dependence of windows in a statistic. `influence`: windows' contributions to its deviation from
/// its expectation, with sum 0; `weight`: weights of the windows in the statistic.
Dependence dependence(const Eigen::VectorXd& influence, const Eigen::VectorXd& weight,
                      const RunLengths& runs);

/// Combination of a and b that leads to the wider interval, member by member.
Dependence worse(const Dependence& a, const Dependence& b);

}  // namespace grseg
