// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/composition_fit.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <utility>
#include <vector>

namespace grseg {
namespace {

/// Values of phi_L from 0.01 to 0.99.
Eigen::VectorXd compositions(Eigen::Index count)
{
  return Eigen::VectorXd::LinSpaced(count, 0.01, 0.99);
}

Eigen::VectorXd ratio(const Eigen::VectorXd& phi)
{
  return (1 - phi.array()) / phi.array();
}

/// 1, 2, 3, 1, 2, 3, ...
Eigen::VectorXd weights(Eigen::Index count)
{
  Eigen::VectorXd values(count);
  for (Eigen::Index k = 0; k < count; ++k) values[k] = static_cast<double>(1 + k % 3);
  return values;
}

// A power law y = k x^a and a B that grows linearly with phi_L follow from the composition alone.
TEST(CompositionFit, APowerLawAndALineOverCompositionAreNone)
{
  const auto phi = compositions(50);
  const Eigen::VectorXd law = 0.3 + 0.7 * ratio(phi).array().log() - 1.1 * phi.array();
  EXPECT_LT(CompositionFit(phi, weights(50)).noise(law).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(CompositionFit, AddsUpToZero)
{
  const auto phi = compositions(40);
  const Eigen::VectorXd value = (37 * phi.array()).sin(), weight = weights(40);
  const Eigen::VectorXd noise = CompositionFit(phi, weight).noise(value);
  EXPECT_NEAR(noise.dot(weight), 0, 1e-12);
  EXPECT_NEAR(noise.cwiseProduct(weight).dot(phi), 0, 1e-12);
  EXPECT_GT(noise.norm(), 0.8 * value.norm());
}

TEST(CompositionFit, OfOneCompositionIsTheDeviationFromTheMean)
{
  const Eigen::VectorXd phi = Eigen::VectorXd::Constant(60, 0.3), weight = weights(60);
  const Eigen::VectorXd value = Eigen::VectorXd::LinSpaced(60, -1, 5);
  const Eigen::VectorXd deviation = value.array() - value.dot(weight) / weight.sum();
  EXPECT_LT((CompositionFit(phi, weight).noise(value) - deviation).norm(), 1e-12);
}

// Below thirty points the two terms count by (points - 10)/20: a line leaves 1, 3/4 and 1/20 of itself.
TEST(CompositionFit, CountsByTheNumberOfPointsWhereTheyAreFew)
{
  for (const auto& [points, left] :
       {std::pair{8, 1.0}, {10, 1.0}, {15, 0.75}, {29, 0.05}, {30, 0.0}}) {
    const auto phi = compositions(points);
    const CompositionFit fit(phi, Eigen::VectorXd::Ones(points));
    EXPECT_NEAR(fit.noise(phi)[0], left * (0.01 - 0.5), 1e-14) << points;
  }
}

// The terms are a line and a curve over the compositions. In windows of one layer each, phi_L minus its
// mean is taken whole, and what the fit leaves of any number is the rest of its sum of squares.
TEST(CompositionFit, TakesFromANumberByWindowWhatItDoesNotLeave)
{
  const auto phi = compositions(40);
  const Eigen::VectorXd weight = weights(40);
  const CompositionFit fit(phi, weight);
  std::vector<std::size_t> window(40);
  std::iota(window.begin(), window.end(), 0);
  const auto part_taken = [&](const Eigen::VectorXd& value) {
    const Eigen::VectorXd rest = value.array() - weight.dot(value) / weight.sum();
    return (fit.taken(window, 40).transpose() * rest).squaredNorm() / weight.dot(rest.cwiseAbs2());
  };
  EXPECT_NEAR(part_taken(phi), 1, 1e-12);
  const Eigen::VectorXd value = (5 * phi.array()).sin();
  const double left = weight.dot(fit.noise(value).cwiseAbs2()),
               all =
                   weight.dot((value.array() - weight.dot(value) / weight.sum()).square().matrix());
  EXPECT_NEAR(part_taken(value), 1 - left / all, 1e-12);
  EXPECT_GT(left / all, 0.01);
}

}  // namespace
}  // namespace grseg
