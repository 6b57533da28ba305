// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>

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

}  // namespace grseg
