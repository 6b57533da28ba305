// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/estimators.hpp"
#include "analysis/fit/fit_data.hpp"
#include "analysis/statistics/confidence.hpp"

#include <Eigen/Core>
#include <vector>

namespace grseg {

/// By how much each window moves every estimator: d(estimator)/d(sums) times the window's sums, one
/// column per entry of estimator_columns. Columns of `sums` add up to 0, since estimators are ratios.
struct Influences {
  Eigen::MatrixXd sums;  // of all that the window holds: what whole runs differ by
  Eigen::MatrixXd
      noise;  // of what composition does not explain: what windows inside a run differ by
};
Influences influences_of(const WindowSums& windows);
/// Where an estimator stands in them.
Eigen::Index column_of_estimator(double Estimators::*place);

/// Errors of statistics over whole runs, the flows being fixed: those of the flows added. Of a
/// flow with a single run the scatter of its windows stands for that of runs, about what each
/// window would add if it were like the run, which goes by its weight.
class RunErrors {
 public:
  /// weight: of each window.
  RunErrors(const FitData& data, const Eigen::VectorXd& weight);

  /// Of a statistic whose deviation is the sum of the windows' influences.
  StandardError within_flows(const Eigen::VectorXd& sums, const Eigen::VectorXd& noise) const;
  /// The chance that runs of like flows differ between flows as much as these do, by Fisher's
  /// test of the mean squares of influence over weight between and within flows; 1 where it cannot
  /// be told. `fitted`: of the differences between flows, how many degrees of freedom were taken
  /// out of the influence beforehand; at least one counts as left.
  double chance_of_likeness(const Eigen::VectorXd& influence, double fitted) const;
  /// Flows with a single run.
  std::size_t single_runs() const;

 private:
  struct Group {
    std::vector<std::size_t> first, length;  // of each run: its first window, how many
    Eigen::VectorXd weight;                  // of each run
  };
  Eigen::VectorXd weight_;  // of each window
  std::vector<Group> groups_;
};

}  // namespace grseg
