// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/fit/estimators.hpp"
#include "analysis/statistics/dependence.hpp"

#include <Eigen/Core>
#include <vector>

namespace grseg {

/// Additive sums from which every estimator follows, one row per window, and what of them is noise:
/// the part that the layers' compositions do not explain, which is what resampling varies. With f the
/// frames of a point, w its weight, x = phi_S/phi_L, y = sigma^S/sigma^L, D = psi_L - phi_L and
/// Q = phi_L phi_S, the columns are the sums over a window's points of f D and f Q (of points whose
/// whole stress is positive), w, w ln x, w ln y, w (ln x)^2 and w ln x ln y (of those with a
/// logarithm).
struct WindowSums {
  Eigen::MatrixXd sums, noise;

  /// The sums of all windows.
  Eigen::RowVectorXd total() const { return sums.colwise().sum(); }
  /// Of each window in B, and in the mean of ln(y/x).
  Eigen::VectorXd weight() const;
  Eigen::VectorXd weight_of_logarithms() const;
  /// Of each window the sum over its layers of frames x (psi_L - phi_L), and what of it is noise.
  Eigen::VectorXd excess() const;
  Eigen::VectorXd excess_noise() const;
  /// The sums of samples that count window k times(sample, k) times, a row per sample.
  Eigen::MatrixXd totals(const Eigen::MatrixXd& times) const;
};
WindowSums window_sums(const std::vector<FitPoint>& points, const RunLengths& runs);

/// How far the windows are from independent for B; where stresses do not add up, and so have no B,
/// for the mean of ln(y/x).
Dependence dependence(const WindowSums& windows, const RunLengths& runs, bool adds_up);

/// The same estimates as from the points, from totals of those sums.
Estimators estimators_from_sums(const Eigen::RowVectorXd& total);

}  // namespace grseg
