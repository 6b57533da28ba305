// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/statistics/confidence.hpp"

#include <Eigen/Core>
#include <string>

namespace grseg {

/// Least-squares fit of y = end - (end - start) exp(-(x - x_0)/scale), with x_0 the first x, by
/// Levenberg and Marquardt (GSL).
///
/// Intervals take into account that residuals are correlated in time (standard_error). The interval
/// of `scale` is the interval of the rate 1/scale, inverted, so it is not symmetric.
struct ExponentialApproach {
  Estimate start, end, scale;
  /// Reason why there is no fit, as the predicate of a sentence; empty if there is one. There is no
  /// fit if the data do not distinguish the curve from a straight line, or from no change.
  std::string trouble;

  // Quantities that time_to() needs.
  double scatter = 0;           // r.m.s. of the residuals, in the unit of y
  Eigen::MatrixX2d influences;  // influence of each observation (row) on start and end
};

/// Fits y(x). x must increase, e.g. time or strain; x and y have the same length.
ExponentialApproach fit_approach(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// First x - x_0 at which y has covered the share `part` of the way from the fit's start to its
/// end, interpolated linearly between observations. NaN if y never does, or without a fit.
Estimate time_to(double part, const ExponentialApproach& fit, const Eigen::VectorXd& x,
                 const Eigen::VectorXd& y);

}  // namespace grseg
