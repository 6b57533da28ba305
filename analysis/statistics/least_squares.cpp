// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/least_squares.hpp"

#include <Eigen/QR>
#include <map>

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

namespace {

/// Least number of points for a fit; fewer points are fitted by their mean.
constexpr Eigen::Index fewest = 30;

Eigen::MatrixX3d basis_of(const Eigen::VectorXd& phi_large)
{
  Eigen::MatrixX3d basis(phi_large.size(), 3);
  basis.col(0).setOnes();
  basis.col(1) = ((1 - phi_large.array()) / phi_large.array()).log();
  basis.col(2) = phi_large;
  return basis;
}

LeastSquares fit_of(const Eigen::MatrixX3d& basis, const Eigen::VectorXd& root_of_weight)
{
  // The threshold allows for one or two compositions, which determine fewer coefficients.
  return LeastSquares(root_of_weight.asDiagonal() * basis, 1e-6);
}

}  // namespace

Eigen::VectorXd composition_noise(const Eigen::VectorXd& phi_large, const Eigen::VectorXd& value,
                                  const Eigen::VectorXd& weight)
{
  if (value.size() < fewest) return value.array() - value.dot(weight) / weight.sum();
  const auto basis = basis_of(phi_large);
  const Eigen::VectorXd root = weight.cwiseSqrt();
  return value - basis * fit_of(basis, root).solve(root.cwiseProduct(value));
}

double degrees_of_composition(const Eigen::VectorXd& phi_large, const Eigen::VectorXd& weight,
                              const std::vector<std::size_t>& group)
{
  if (phi_large.size() < fewest) return 1;
  const Eigen::VectorXd root = weight.cwiseSqrt();
  const auto basis = basis_of(phi_large);
  const auto fit = fit_of(basis, root);
  // `members` are 1 in one group and 0 elsewhere; the fit reproduces a part of each.
  std::map<std::size_t, Eigen::VectorXd> members;
  for (std::size_t k = 0; k < group.size(); ++k) {
    auto& own =
        members.try_emplace(group[k], Eigen::VectorXd::Zero(phi_large.size())).first->second;
    own[static_cast<Eigen::Index>(k)] = 1;
  }
  double degrees = 0;
  for (const auto& [number, own] : members) {
    const Eigen::VectorXd fitted = basis * fit.solve(root.cwiseProduct(own));
    degrees += weight.cwiseProduct(own).dot(fitted) / weight.dot(own);
  }
  return degrees;
}

}  // namespace grseg
