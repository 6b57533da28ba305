// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace grseg {

/// Least-squares solution x of A x = b for any b. If the columns of A are linearly dependent, x is
/// the shortest solution.
class LeastSquares {
 public:
  /// Pivots below `threshold` times the largest pivot count as 0.
  explicit LeastSquares(const Eigen::MatrixXd& a,
                        double threshold = std::numeric_limits<double>::epsilon());

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::Index rank() const;

 private:
  struct Decomposition;  // defined in the .cpp, because it takes ten seconds to compile
  std::shared_ptr<const Decomposition> decomposition_;
};

/// Part of a quantity of layers that composition does not explain: `value` minus its least-squares
/// fit a + b ln(phi_S/phi_L) + c phi_L with weights `weight`; minus its mean if there are fewer
/// than ten points per coefficient. The weighted sum of the result is 0.
///
/// One B does not describe all compositions, and the compositions of a segregating flow drift. The
/// drift is known, not random. If it were left in the noise, all windows would seem correlated.
Eigen::VectorXd composition_noise(const Eigen::VectorXd& phi_large, const Eigen::VectorXd& value,
                                  const Eigen::VectorXd& weight);

/// Degrees of freedom that the fit of composition_noise() removes from differences between groups
/// of points: the sum of the squared canonical correlations between the terms of the fit and the
/// groups. It is 1, for the mean, if all groups have the same compositions, and 3 if each group has
/// a single composition of its own.
double degrees_of_composition(const Eigen::VectorXd& phi_large, const Eigen::VectorXd& weight,
                              const std::vector<std::size_t>& group);

}  // namespace grseg
