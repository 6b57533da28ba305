// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace grseg {

/// The x of least |A x - b| for any b. Where the columns of A depend on each other, their rank is
/// less than their number, and x the shortest of all that will do.
class LeastSquares {
 public:
  /// Pivots below `threshold` times the largest one are taken for 0.
  explicit LeastSquares(const Eigen::MatrixXd& a,
                        double threshold = std::numeric_limits<double>::epsilon());

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::Index rank() const;

 private:
  struct Decomposition;  // compiled once: it costs a compiler ten seconds
  std::shared_ptr<const Decomposition> decomposition_;
};

/// Part of a quantity of layers that composition does not explain: `value` less its fit by a + b
/// ln(phi_S/phi_L) + c phi_L, least squares with `weight`; the mean alone where points are fewer
/// than ten per coefficient. Weighted, the rest adds up to 0.
///
/// One B does not describe all compositions, and the compositions of a flow that segregates drift.
/// Drift is known, not chance: left in the noise, it would make all windows depend on each other
/// for ever.
Eigen::VectorXd composition_noise(const Eigen::VectorXd& phi_large, const Eigen::VectorXd& value,
                                  const Eigen::VectorXd& weight);

/// How much of the differences between groups of points that fit takes, in degrees of freedom: the
/// sum of the squared canonical correlations between its terms and the groups. 1, the mean, where
/// all groups have the same compositions; 3 where each has but one of its own.
double degrees_of_composition(const Eigen::VectorXd& phi_large, const Eigen::VectorXd& weight,
                              const std::vector<std::size_t>& group);

}  // namespace grseg
