// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/least_squares.hpp"

#include <gtest/gtest.h>

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
TEST(CompositionNoise, APowerLawAndALineOverCompositionAreNone)
{
  const auto phi = compositions(50);
  const Eigen::VectorXd law = 0.3 + 0.7 * ratio(phi).array().log() - 1.1 * phi.array();
  EXPECT_LT(composition_noise(phi, law, weights(50)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(CompositionNoise, AddsUpToZero)
{
  const auto phi = compositions(40);
  const Eigen::VectorXd value = (37 * phi.array()).sin(), weight = weights(40);
  const Eigen::VectorXd noise = composition_noise(phi, value, weight);
  EXPECT_NEAR(noise.dot(weight), 0, 1e-12);
  EXPECT_NEAR(noise.cwiseProduct(weight).dot(phi), 0, 1e-12);
  EXPECT_GT(noise.norm(), 0.8 * value.norm());
}

TEST(CompositionNoise, OfOneCompositionIsTheDeviationFromTheMean)
{
  const Eigen::VectorXd phi = Eigen::VectorXd::Constant(60, 0.3), weight = weights(60);
  const Eigen::VectorXd value = Eigen::VectorXd::LinSpaced(60, -1, 5);
  const Eigen::VectorXd deviation = value.array() - value.dot(weight) / weight.sum();
  EXPECT_LT((composition_noise(phi, value, weight) - deviation).norm(), 1e-12);
}

// Each coefficient needs ten points: with fewer than 30 points no trend is fitted.
TEST(CompositionNoise, OfFewPointsIsTheDeviationFromTheMean)
{
  const auto phi = compositions(29);
  const Eigen::VectorXd weight = Eigen::VectorXd::Ones(29);
  EXPECT_NEAR(composition_noise(phi, phi, weight)[0], 0.01 - 0.5, 1e-15);
}

/// Four groups of ten points: point k of group g is at `of(g, k)`.
template <class Of>
double degrees_of_four_groups(const Of& of)
{
  Eigen::VectorXd phi(40);
  std::vector<std::size_t> group;
  for (Eigen::Index k = 0; k < 40; ++k) {
    phi[k] = of(static_cast<double>(k / 10), static_cast<double>(k % 10));
    group.push_back(static_cast<std::size_t>(k / 10));
  }
  return degrees_of_composition(phi, Eigen::VectorXd::Ones(40), group);
}

// If groups have different compositions, the fit explains what line, curve and mean can: 3 of 4
// degrees. If groups are alike it only removes their mean.
TEST(CompositionNoise, TakesThreeDegreesOfGroupsThatAreApartAndOneOfGroupsThatAreAlike)
{
  EXPECT_NEAR(degrees_of_four_groups([](double g, double) { return 0.2 + 0.15 * g; }), 3, 1e-9);
  EXPECT_NEAR(degrees_of_four_groups([](double, double k) { return 0.05 + 0.1 * k; }), 1, 1e-9);
  const double between =
      degrees_of_four_groups([](double g, double k) { return 0.1 + 0.1 * g + 0.05 * k; });
  EXPECT_GT(between, 1.1);
  EXPECT_LT(between, 2.9);
}

}  // namespace
}  // namespace grseg
