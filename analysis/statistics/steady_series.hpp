// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/statistics/correlated_windows.hpp"

#include <Eigen/Core>
#include <functional>
#include <optional>

/// Tests of series with one number per window, run after run: a start that does not belong to the
/// rest, and a change in time. Their rates of error: docs/studies/uncertainty.md.
namespace grseg {

/// A quantity of each window, `above`/`below`, such as B with its weight.
struct Series {
  Eigen::VectorXd above, below;

  explicit Series(const Eigen::VectorXd& values)
      : above(values), below(Eigen::VectorXd::Ones(values.size()))
  {
  }
  Series(const Eigen::VectorXd& of, const Eigen::VectorXd& weight) : above(of), below(weight) {}

  double mean() const { return above.sum() / below.sum(); }
  /// The series without the first `fraction` of each run; `runs` becomes the lengths of the rest.
  Series without_start(double fraction, RunLengths& runs) const;
};

/// Means over an early and a late part of the windows of all runs.
struct Change {
  double first = 0, last = 0;
  StandardError error{no_number, 0};  // of last - first; NaN in too few windows

  /// Probability of a change at least this large if there is none; 1 if the error is unknown.
  double chance() const;
  bool is_known() const { return error.degrees > 0; }
  /// True if the 95 % interval of the change leaves 0 out.
  bool is_seen() const { return chance() < 0.05; }
  double size() const { return last - first; }
};

/// The change from the first to the last third, by Student's t. Variance, autocorrelation time and
/// degrees of freedom come from the windows of all runs about a straight line in each run, so that a
/// drift does not count as noise. Nothing if a run has fewer than three windows.
std::optional<Change> change_of(const Series& series, const RunLengths& runs);

/// The change from the first tenth to the last half, by Student's t (Geweke 1992). Variance,
/// autocorrelation time and degrees of freedom come from the last half; several runs are averaged.
/// Nothing if a run has fewer than ten windows. The series must have `below` = 1.
std::optional<Change> start_of(const Series& series, const RunLengths& runs);

/// The least fraction of each run, in steps of 1/20 and at most 1/2, without which `is_steady(series,
/// runs)` is true of the rest; 1 if there is none.
double start_to_leave_out(const Series& series, const RunLengths& runs,
                          const std::function<bool(const Series&, const RunLengths&)>& is_steady);

/// start_to_leave_out() by start_of(): 0 if the chance is at least `rarely`, so that 5 % of steady
/// flows show a start in one of two series. Otherwise the rest has a chance of at least `unseen`, so
/// that less of the start remains in it than would only just not be seen.
inline constexpr double rarely = 0.025, unseen = 0.2;
double seen_start(const Series& series, const RunLengths& runs);

}  // namespace grseg
