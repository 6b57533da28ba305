// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/sums.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <functional>
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

/// Error of a statistic whose deviation is the sum of `influence`, one entry per observation of one
/// run in order of time, where `fitted` parameters were taken from the same n observations:
///   error^2 = tau sum influence^2 / (1 - fitted tau/n),  degrees = n/tau - fitted,
/// tau the integrated autocorrelation time of the influence (autocorrelation_time). NaN and 0
/// degrees below least_degrees.
StandardError standard_error(const Eigen::VectorXd& influence, int fitted);

/// Likewise, of observations that are independent but for a slow change, which is no error: from
/// their successive differences (von Neumann 1941), error^2 = n/(n - 1) sum (difference)^2/2 with
/// 2 (n - 1)/3 degrees of freedom.
StandardError error_about_trend(const Eigen::VectorXd& influence);

/// Errors from whole runs: each is one observation, whatever goes on inside it.

/// Error of a statistic whose deviation is the sum of `influence`, one entry per run of one
/// mixture. A run like its mixture would have an influence in proportion to its `weight` W, and is
/// compared with that. With R runs worth m = (sum W)^2/sum W^2 of equal weight,
///   error^2 = m/(m - 1) sum e^2,  e = influence - (sum influence) W/sum W,  degrees = m - 1.
/// NaN and 0 degrees for a single run.
StandardError scatter_of_runs(const Eigen::VectorXd& influence, const Eigen::VectorXd& weight);

/// Error of a sum of independent parts: error^2 = sum of theirs, degrees by Satterthwaite (1946)
/// with the fourth powers freed of their bias, which matters where parts have one degree each
/// (Welch 1947):
///   degrees = error^4/sum(error_k^4/(degrees_k + 2)) - 2,
/// not less than the least of the parts nor more than their sum. NaN where one part is unknown.
StandardError added(const std::vector<StandardError>& parts);

/// Error of the unweighted mean of independent values (Student 1908); n - 1 degrees.
StandardError scatter_of_values(const Eigen::VectorXd& values);

/// The unweighted mean of independent numbers: its error by theirs (`added`), the numbers being
/// these very ones, and by their scatter (`scatter_of_values`), these being drawn from all.
struct MeanOfEquals {
  double value;
  StandardError by_errors, by_scatter;
};
MeanOfEquals mean_of_equals(const std::vector<Measured>& numbers);

/// Windows per run. A series lists the windows of all runs, one run after the other.
using RunLengths = std::vector<std::size_t>;
std::size_t number_of_windows(const RunLengths& runs);

/// Its place in a vector of Eigen.
inline Eigen::Index index(std::size_t window)
{
  return static_cast<Eigen::Index>(window);
}

/// Results of `of`, a function or a member, for each in a list.
template <class List, class Of>
Eigen::VectorXd numbers_of(const List& list, const Of& of)
{
  Eigen::VectorXd numbers(index(list.size()));
  Eigen::Index place = 0;
  for (const auto& one : list) numbers[place++] = std::invoke(of, one);
  return numbers;
}

/// How far the windows of a series are from independent.
struct Dependence {
  double time = 1;               // integrated autocorrelation time in windows, at least 1
  std::size_t block = 1;         // windows drawn together
  double effective_windows = 0;  // (sum b)^2 / sum b^2 of the windows' weights b
  double effective_runs = 0;     // the same of the runs' weights

  double independent_windows() const { return effective_windows / time; }
};

/// 1 + 2 sum of the autocorrelation function; each run about its own mean, all runs together. The
/// larger of the sum up to the first lag >= 5 times the result (Madras & Sokal 1988), corrected for
/// the subtracted mean (Wolff 2004), and of (1 + rho)/(1 - rho) with rho the correlation of
/// neighbours, corrected for its bias (Kendall 1954). Never below 1.
double autocorrelation_time(const Eigen::VectorXd& series, const RunLengths& runs);

/// rho of the AR(1) series whose autocorrelation time is `time` = (1 + rho)/(1 - rho).
double neighbour_correlation(double time);

/// The block length with the least error of the variance for an AR(1) series of the same
/// autocorrelation time tau: (sqrt(6) rho/(1 - rho^2))^(2/3) n^(1/3), rho = (tau - 1)/(tau + 1), n
/// windows per run (Carlstein 1986), at least 1, and short enough to leave two blocks per degree
/// of freedom.
std::size_t block_length(double time, const RunLengths& runs);

/// Dependence of windows in a statistic. `influence`: the windows' shares in its deviation, which
/// add up to 0; `weight`: their weight in it.
Dependence dependence(const Eigen::VectorXd& influence, const Eigen::VectorXd& weight,
                      const RunLengths& runs);

/// Part by part, the value of a or b that leads to the wider interval.
Dependence worse(const Dependence& a, const Dependence& b);

}  // namespace grseg
