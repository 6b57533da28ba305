// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/rates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace grseg {
namespace {

constexpr double S = 3e-3, D = 1.2e-4;

/// 10 layers in 48 windows whose fluxes follow q = S phi_L phi_S - D d phi_L/dy, plus noise that is
/// independent from point to point. Composition differs between windows and layers.
std::vector<RatePoint> points(double noise, unsigned seed = 1)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> kick(0, noise);
  std::vector<RatePoint> all;
  for (std::size_t window = 0; window < 48; ++window)
    for (int layer = 0; layer < 10; ++layer) {
      RatePoint point{};
      point.window = window;
      point.bottom = 0.02 * layer;
      point.top = 0.02 * (layer + 1);
      point.solid = 0.78;
      point.diameter = 0.007;
      point.bed = 0.3;
      auto& r = point.layer;
      r.mass = 0.005;
      r.flow.du_dy = 20;
      r.displacements = {1000, 200};
      const double phi = 0.1 + 0.08 * layer - 0.001 * static_cast<double>(window);
      r.value.phi_large = phi;
      r.value.gradient = 4 * std::sin(layer + 0.1 * static_cast<double>(window));
      r.value.q_large = S * phi * (1 - phi) - D * r.value.gradient + S * kick(random);
      r.value.D = r.value.D_small = D + D * kick(random);
      r.value.D_large = D;
      r.value.Dhat_small = r.value.Dhat_large = D / (20 * 0.007 * 0.007);
      all.push_back(point);
    }
  return all;
}

Estimate number(const NamedNumbers& summary, const std::string& name)
{
  for (const auto& [known, estimate] : summary.numbers)
    if (known == name) return estimate;
  ADD_FAILURE() << name;
  return {};
}

// Differences of neighbours -2, 2, -2: 4/3 * 12/2.
TEST(ErrorAboutTrend, ItIsThatOfTheDifferencesOfNeighbours)
{
  const auto error = error_about_trend(Eigen::Vector4d{1, -1, 1, -1});
  EXPECT_NEAR(error.error, std::sqrt(8), 1e-14);
  EXPECT_NEAR(error.degrees, 2, 1e-14);
  EXPECT_NEAR(error.around(3).high, 3 + 4.302652729749464 * std::sqrt(8), 1e-9);  // t_0.975(2)
  EXPECT_TRUE(std::isnan(error_about_trend(Eigen::Vector2d{1, -1}).around(3).low));
}

TEST(SegregationRates, AFluxThatObeysTheLawGivesItsCoefficients)
{
  const auto summary = segregation_rates(points(0));
  EXPECT_TRUE(summary.remarks.empty());
  EXPECT_NEAR(number(summary, "S[m/s]").value, S, 1e-15);
  EXPECT_NEAR(number(summary, "S[m/s]").high, S, 1e-15);
  EXPECT_NEAR(number(summary, "Shat").value, S / (20 * 0.007), 1e-13);
  EXPECT_NEAR(number(summary, "D[m^2/s]").value, D, 1e-17);
  EXPECT_NEAR(number(summary, "Pe").value, S * 0.3 / D, 1e-11);
  EXPECT_NEAR(number(summary, "lambda[m]").value, D / S, 1e-14);
  EXPECT_NEAR(number(summary, "S_flux[m/s]").value, S, 1e-15);
  EXPECT_NEAR(number(summary, "D_flux[m^2/s]").value, D, 1e-16);
}

// 95 of 100, within three standard deviations of such a count.
TEST(SegregationRates, IntervalsHoldTheTruth)
{
  int pe = 0, held_S = 0, held_D = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const auto summary = segregation_rates(points(0.3, seed));
    const auto holds = [&](const char* name, double truth) {
      const auto estimate = number(summary, name);
      return estimate.low <= truth && truth <= estimate.high ? 1 : 0;
    };
    held_S += holds("S[m/s]", S);
    held_D += holds("D_flux[m^2/s]", D);
    pe += holds("Pe", S * 0.3 / D);
  }
  for (const int held : {held_S, held_D, pe}) {
    EXPECT_GE(held, 181);
    EXPECT_LE(held, 199);
  }
}

// The mean of a diffusivity that doubles during the run is known well.
TEST(SegregationRates, ASlowChangeIsNoError)
{
  auto changing = points(0.01);
  for (auto& point : changing)
    point.layer.value.D_small *= 1 + static_cast<double>(point.window) / 47;
  const auto estimate = number(segregation_rates(changing), "D_S[m^2/s]");
  EXPECT_NEAR(estimate.value, 1.5 * D, 0.01 * D);
  EXPECT_LT(estimate.high - estimate.low, 0.02 * D);
}

TEST(SegregationRates, LayersOutsideTheRangeAndSprayAreLeftOut)
{
  auto all = points(0);
  for (auto& point : all)
    if (point.top > 0.19) point.solid = 0.3;
  EXPECT_EQ(filtered(all, {}, {0.005, 0.01}).size(), 48 * 9u);
  const auto inside = filtered(all, {.heights = "0.02m:0.1m"}, {0.005, 0.01});
  EXPECT_EQ(inside.size(), 48 * 4u);
  for (const auto& point : inside) {
    EXPECT_GE(point.bottom, 0.0199);
    EXPECT_LE(point.top, 0.1001);
  }
  EXPECT_EQ(filtered(all, {.min_solid = 0}, {0.005, 0.01}).size(), all.size());
}

TEST(SegregationRates, WithoutLargeGrainsARemarkReplacesTheNumber)
{
  auto pure = points(0);
  for (auto& point : pure) {
    point.layer.value.phi_large = point.layer.value.q_large = point.layer.value.gradient = 0;
    point.layer.value.D_large = std::nan("");
    point.layer.displacements[1] = 0;
  }
  const auto summary = segregation_rates(pure);
  EXPECT_NEAR(number(summary, "D_S[m^2/s]").value, D, 1e-15);
  EXPECT_TRUE(std::isnan(number(summary, "D_L[m^2/s]").value));
  EXPECT_TRUE(std::isnan(number(summary, "S[m/s]").value));
  EXPECT_TRUE(std::isnan(number(summary, "S_flux[m/s]").value));
  ASSERT_FALSE(summary.remarks.empty());
  EXPECT_EQ(summary.remarks[0], "D_L[m^2/s]: too few windows with both species for a value");
  EXPECT_TRUE(std::isnan(number(segregation_rates({}), "Pe").value));
}

}  // namespace
}  // namespace grseg
