// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/composition_fit.hpp"

#include "analysis/statistics/confidence.hpp"

#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// Points below which composition explains nothing, and from which the fit counts in full.
constexpr double fewest = 10, enough = 30;
/// Least deviation of a term from its mean; the deviations of one composition are rounding errors.
constexpr double least_deviation = 1e-6;

/// ln(phi_S/phi_L) and phi_L, minus their weighted means.
Eigen::MatrixX2d centred_terms(const Eigen::VectorXd& phi_large, const Eigen::VectorXd& weight)
{
  Eigen::MatrixX2d terms(phi_large.size(), 2);
  terms.col(0) = ((1 - phi_large.array()) / phi_large.array()).log();
  terms.col(1) = phi_large;
  const Eigen::RowVector2d mean = weight.transpose() * terms / weight.sum();
  return terms.rowwise() - mean;
}

}  // namespace

CompositionFit::CompositionFit(const Eigen::VectorXd& phi_large, const Eigen::VectorXd& weight)
    : weight_(weight),
      strength_(
          std::clamp((static_cast<double>(weight.size()) - fewest) / (enough - fewest), 0.0, 1.0))
{
  // Gram and Schmidt's method. Two compositions determine only one of the terms.
  terms_ = centred_terms(phi_large, weight);
  const auto product = [&](Eigen::Index j, Eigen::Index k) {
    return weight.dot(terms_.col(j).cwiseProduct(terms_.col(k)));
  };
  Eigen::Index used = 0;
  for (Eigen::Index k = 0; k < 2; ++k) {
    terms_.col(used) = terms_.col(k);
    for (int twice = 0; twice < 2 && used == 1; ++twice)
      terms_.col(1) -= product(0, 1) * terms_.col(0);
    const double norm = std::sqrt(product(used, used));
    if (norm > least_deviation * std::sqrt(weight.sum())) terms_.col(used++) /= norm;
  }
  terms_.conservativeResize(Eigen::NoChange, used);
}

Eigen::VectorXd CompositionFit::noise(const Eigen::VectorXd& value) const
{
  const Eigen::VectorXd deviation = value.array() - value.dot(weight_) / weight_.sum();
  return deviation - strength_ * terms_ * (terms_.transpose() * weight_.cwiseProduct(deviation));
}

Eigen::MatrixXd CompositionFit::taken(const std::vector<std::size_t>& group,
                                      std::size_t groups) const
{
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(index(groups), terms_.cols());
  for (std::size_t k = 0; k < group.size(); ++k)
    sums.row(index(group[k])) += weight_[index(k)] * terms_.row(index(k));
  return std::sqrt(strength_ * (2 - strength_)) * sums;
}

}  // namespace grseg
