// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>

namespace grseg {

/// The x of least |A x - b| for any b. Where the columns of A depend on each other, their rank is less than
/// their number, and x the shortest of all that will do.
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

}  // namespace grseg
