// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/composition_noise.hpp"

#include <Eigen/QR>

namespace grseg {

Eigen::VectorXd composition_noise(const Eigen::VectorXd& phi_large, const Eigen::VectorXd& value,
                                  const Eigen::VectorXd& weight)
{
  if (value.size() < 30) return value.array() - value.dot(weight) / weight.sum();
  Eigen::MatrixX3d basis(value.size(), 3);
  basis.col(0).setOnes();
  basis.col(1) = ((1 - phi_large.array()) / phi_large.array()).log();
  basis.col(2) = phi_large;
  const Eigen::VectorXd root = weight.cwiseSqrt();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixX3d> fit;
  fit.setThreshold(1e-6);  // one or two compositions determine fewer coefficients
  fit.compute(root.asDiagonal() * basis);
  return value - basis * fit.solve(root.cwiseProduct(value));
}

}  // namespace grseg
