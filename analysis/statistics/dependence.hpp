// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

namespace grseg {

/// Windows per run. A series lists the windows of all runs, one run after the other.
using RunLengths = std::vector<std::size_t>;
std::size_t number_of_windows(const RunLengths& runs);

/// Its place in a vector of Eigen.
inline Eigen::Index index(std::size_t window)
{
  return static_cast<Eigen::Index>(window);
}

/// What `of`, a function or a member, says of each in a list.
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

/// Of `influence`, the windows' shares in the deviation of a statistic (they add up to 0), and
/// their `weight` in it.
Dependence dependence(const Eigen::VectorXd& influence, const Eigen::VectorXd& weight,
                      const RunLengths& runs);

/// Of each the part that leads to the wider interval.
Dependence worse(const Dependence& a, const Dependence& b);

}  // namespace grseg
