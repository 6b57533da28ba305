// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/least_squares.hpp"

#include <Eigen/QR>

namespace grseg {

struct LeastSquares::Decomposition {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> of;
};

LeastSquares::LeastSquares(const Eigen::MatrixXd& a, double threshold)
{
  auto decomposition = std::make_shared<Decomposition>();
  decomposition->of.setThreshold(threshold);
  decomposition->of.compute(a);
  decomposition_ = decomposition;
}

Eigen::VectorXd LeastSquares::solve(const Eigen::VectorXd& b) const
{
  return decomposition_->of.solve(b);
}

Eigen::Index LeastSquares::rank() const
{
  return decomposition_->of.rank();
}

}  // namespace grseg
