// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace grseg {

/// The part of a quantity of points (layers in windows) that their compositions explain: its weighted
/// least-squares fit a + b ln(phi_S/phi_L) + c phi_L. Below thirty points b and c are hardly known: they count by
/// (points - 10)/20, and below ten points only the mean is subtracted.
///
/// One B does not describe all compositions, and the compositions of a segregating flow drift. The
/// drift is known, not random. If it were left in the noise, all windows would seem correlated.
class CompositionFit {
 public:
  CompositionFit(const Eigen::VectorXd& phi_large, const Eigen::VectorXd& weight);

  /// `value` minus its fit. The weighted sum of the result is 0.
  Eigen::VectorXd noise(const Eigen::VectorXd& value) const;
  /// Part of a number per group of points (one of `groups` windows or flows) that the fit takes. If v has
  /// the weighted mean 0 over the points, that part of its weighted sum of squares is |E^T v|^2, E being
  /// the result, with a row per group.
  Eigen::MatrixXd taken(const std::vector<std::size_t>& group, std::size_t groups) const;

 private:
  Eigen::VectorXd weight_;
  Eigen::MatrixXd terms_;  // orthonormal with the weights, and to 1; at most two columns
  double strength_;        // by which the terms count
};

}  // namespace grseg
