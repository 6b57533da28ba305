// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/statistics/confidence.hpp"

#include <Eigen/Core>
#include <string>

namespace grseg {

/// y = end - (end - start) exp(-(x - x_0)/scale), x_0 the first x: the least-squares fit by
/// Levenberg and Marquardt (GSL).
///
/// Intervals allow for residuals that depend on each other over time (standard_error). The scale's
/// interval is the interval of the rate 1/scale turned over, and so is not symmetric.
struct ExponentialApproach {
  Estimate start, end, scale;
  /// Why there are no numbers, as the predicate of a sentence; empty where there are. The numbers
  /// are withheld where the data do not tell the curve from a straight line, or from no change.
  std::string trouble;

  // For what follows from the fit:
  double scatter = 0;           // rms of the residuals
  Eigen::MatrixX2d influences;  // of each observation on start and end
};

/// x increasing, e.g. time or strain; both of the same length.
ExponentialApproach fit_approach(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// Where y first has gone `part` of the way from the fit's start to its end: x - x_0, between two
/// observations on a straight line. NaN where it never does or without a fit.
Estimate time_to(double part, const ExponentialApproach& fit, const Eigen::VectorXd& x,
                 const Eigen::VectorXd& y);

}  // namespace grseg
