// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/statistics/confidence.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <string>

/// Error bars for means over correlated windows: moving blocks of consecutive windows (Kuensch
/// 1989) and, where there are several, whole runs are drawn with replacement. What is drawn is how
/// often each window counts, so a statistic made of sums over windows costs one matrix product.
/// How often the intervals hold the truth: docs/studies/uncertainty.md.
namespace grseg {

class Bootstrap {
 public:
  /// samples = 0: no intervals. The same seed draws the same samples in any order of calls.
  Bootstrap(RunLengths runs, std::size_t samples, unsigned long seed);

  const RunLengths& runs() const { return runs_; }
  std::size_t count() const { return samples_; }  // of samples
  std::size_t windows() const;

  /// Row = sample, column = window: how often the window counts when blocks of `length`
  /// consecutive windows are drawn inside each run.
  const Eigen::MatrixXd& blocks(std::size_t length) const;
  /// Times that each window counts when whole runs are drawn, in the same layout; no rows for a
  /// single run.
  const Eigen::MatrixXd& whole_runs() const;

  /// Samples and interval for the closure of segregation: whole runs are drawn if there are
  /// several, as one population, and blocks of windows if there is one. grseg-fit tells mixtures
  /// apart (RunErrors).
  const Eigen::MatrixXd& samples(const Dependence& dependence) const;
  Estimate estimate(double value, const Eigen::VectorXd& samples,
                    const Dependence& dependence) const;

  /// Error by the windows alone. The interval is value -+ t sqrt(V), with V the variance of the
  /// statistic over samples of blocks(), times m/(m - R) for the means of R runs that were fitted
  /// (m = effective windows/block), over the share of the variance that blocks of b windows of an
  /// AR(1) series keep at their cuts, 1 - 2 rho (1 - rho^b)/(b (1 - rho^2)); t is Student's
  /// quantile of m - R degrees of freedom. NaN below least_degrees. With several runs it holds only
  /// if runs do not differ.
  StandardError window_error(const Eigen::VectorXd& samples, const Dependence& dependence) const;
  /// Error by several runs: as window_error with samples of whole_runs(), m = effective runs and m
  /// - 1 degrees of freedom. Each run is one observation, whatever happens inside it.
  StandardError run_error(const Eigen::VectorXd& samples, const Dependence& dependence) const;

  /// A sentence where an interval may say more than it knows, or far less: too few windows for
  /// their correlation, in all or in each of several runs, two or three runs. Empty otherwise and
  /// for samples = 0.
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
