// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/statistics/confidence.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <string>

/// Error bars for means over correlated windows: moving blocks of consecutive windows (Kuensch
/// 1989) or, for several runs, whole runs are drawn with replacement. A sample is the number
/// of times each window is drawn, so a statistic of sums over windows costs one matrix product.
/// docs/studies/uncertainty.md reports how often the intervals contain the true value.
namespace grseg {

class Bootstrap {
 public:
  /// `samples` = 0: no intervals. A seed draws the same samples in any order of calls.
  Bootstrap(RunLengths runs, std::size_t samples, unsigned long seed);

  const RunLengths& runs() const { return runs_; }
  std::size_t count() const { return samples_; }  // number of samples
  std::size_t windows() const;

  /// Number of times that a window (column) is in a sample (row), if blocks of `length` consecutive
  /// windows are drawn inside each run.
  const Eigen::MatrixXd& blocks(std::size_t length) const;
  /// Number of times that a window (column) is in a sample (row), if whole runs are drawn; no rows
  /// for a single run.
  const Eigen::MatrixXd& whole_runs() const;

  /// Samples and interval for grseg-closure: whole runs are drawn from one population if there are
  /// several, blocks of windows if there is one. grseg-fit separates mixtures (RunErrors).
  const Eigen::MatrixXd& samples(const Dependence& dependence) const;
  Estimate estimate(double value, const Eigen::VectorXd& samples,
                    const Dependence& dependence) const;

  /// Error from the variation between windows. The interval is value -+ t sqrt(V), with t Student's
  /// quantile of m - R degrees of freedom, m = effective windows/block, for R runs. V is the
  /// variance of the statistic over samples of blocks(), times m/(m - R) because the means of R
  /// runs were fitted, divided by 1 - 2 rho (1 - rho^b)/(b (1 - rho^2)), the share of the variance
  /// of an AR(1) series that remains in blocks of b windows. No interval below least_degrees. With
  /// several runs the error is valid only if runs do not differ.
  StandardError window_error(const Eigen::VectorXd& samples, const Dependence& dependence) const;
  /// Error from the variation between runs: window_error() with samples of whole_runs(), m =
  /// effective runs, and m - 1 degrees of freedom. Each run is one observation.
  StandardError run_error(const Eigen::VectorXd& samples, const Dependence& dependence) const;

  /// A warning if an interval may be too narrow, or far too wide: if windows are too few for their
  /// correlation, in total or in each of several runs, or if there are only two or three runs.
  /// Empty otherwise and for samples = 0.
  std::string doubt(const Dependence& dependence) const;
  std::string doubt_of_windows(const Dependence& dependence) const;
  std::string doubt_of_runs(const Dependence& dependence) const;

 private:
  double window_degrees(const Dependence& dependence) const;

  RunLengths runs_;
  std::size_t samples_;
  unsigned long seed_;
  mutable std::map<std::size_t, Eigen::MatrixXd> blocks_;
  mutable Eigen::MatrixXd whole_runs_;
};

}  // namespace grseg
