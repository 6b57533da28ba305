// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/segregation/flux.hpp"
#include "analysis/segregation/rates.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace grseg {
namespace {

const Layers layers(1, 10);

// 100 grains of equal size; the bed is 20 high, so the shear rate is fitted from 2 to 18.
Packing shear(double rate, double kink)
{
  Packing scene;
  for (int g = 0; g < 100; ++g) {
    const double y = 0.1 + 0.2 * g;
    const bool outside = y < 2 || y > 18;
    scene.grain(g < 50 ? Species::large : Species::small, 0.05, {0.1, y},
                {rate * y + (outside ? kink : 0), 0});
  }
  return scene;
}

TEST(SegregationSeries, HeightsAndShearRateAreThoseOfTheBed)
{
  SegregationSeries<2> series(layers);
  const auto scene = shear(3, 50);
  series.add(scene.grains, scene.frame);
  const auto& now = series.states()[0];
  EXPECT_NEAR(now.large, 5, 1e-12);
  EXPECT_NEAR(now.small, 15, 1e-12);
  EXPECT_NEAR(now.bed, 20, 1e-12);
  EXPECT_NEAR(now.shear_rate, 3, 1e-12);
}

// A shear rate that grows linearly from 1 to 5 over 2 s gives a strain of 6.
TEST(SegregationSeries, StrainIsTheIntegralOfTheShearRate)
{
  SegregationSeries<2> whole(layers), first(layers), second(layers);
  for (int k = 0; k <= 20; ++k) {
    auto scene = shear(1 + 0.2 * k, 0);
    scene.frame.time = 5 + 0.1 * k;
    whole.add(scene.grains, scene.frame);
    (k < 8 ? first : second).add(scene.grains, scene.frame);
  }
  EXPECT_NEAR(whole.states().back().strain, 6, 1e-12);
  first.merge(second);
  ASSERT_EQ(first.states().size(), 21u);
  for (std::size_t k = 0; k < 21; ++k)
    EXPECT_NEAR(first.states()[k].strain, whole.states()[k].strain, 1e-12);
}

/// y_L rises exponentially in strain; the shear rate falls from 20 to 10 over the run; the mixing
/// index is a parabola with its maximum at 16.3 s.
std::vector<BedState> history(int count, double scatter)
{
  std::mt19937 random(4);
  std::normal_distribution<double> kick(0, scatter);
  std::vector<BedState> states;
  for (int k = 0; k < count; ++k) {
    BedState now;
    now.time = 2 + 0.05 * k;
    const double t = 0.05 * k;
    now.strain = 20 * t - t * t / 10;
    now.large = 0.25 - 0.2 * std::exp(-now.strain / 200);
    now.bed = 0.5;
    now.mixing = 0.9 - 0.001 * (t - 16.3) * (t - 16.3) + kick(random);
    states.push_back(now);
  }
  return states;
}

Estimate number(const NamedNumbers& summary, const std::string& name)
{
  for (const auto& [known, estimate] : summary.numbers)
    if (known == name) return estimate;
  ADD_FAILURE() << name;
  return {};
}

TEST(SegregationTimes, StrainIsTheClockWhereTheFlowSlowsDown)
{
  const auto summary = segregation_times(history(1000, 1e-3), std::vector<std::size_t>(40, 25));
  EXPECT_NEAR(number(summary, "tau_strain").value, 200, 1e-5);
  EXPECT_NEAR(number(summary, "t50_strain").value, 200 * std::log(2), 0.01);
  EXPECT_NEAR(number(summary, "t90_strain").value, 200 * std::log(10), 0.01);
  const double half = 100 - std::sqrt(1e4 - 2000 * std::log(2));  // 20 t - t^2/10 = 200 ln 2
  // In time the curve is not exactly exponential, so the end of the fit is slightly off.
  EXPECT_NEAR(number(summary, "t50[s]").value, half, 0.2);
}

// Windows of 1.25 s: the expected time is the middle of the window that contains 16.3 s.
TEST(SegregationTimes, TheBedIsMixedMostWhereItsIndexIsLargest)
{
  const auto summary = segregation_times(history(1000, 1e-5), std::vector<std::size_t>(40, 25));
  const auto time = number(summary, "t_mixing[s]");
  EXPECT_NEAR(time.value, 16.3, 1.25 / 2 + 0.025);
  EXPECT_LE(time.low, time.value);
  EXPECT_GE(time.high, time.value);
  EXPECT_LT(time.high - time.low, 3 * 1.25);
  EXPECT_NEAR(number(summary, "mixing_most").value, 0.9, 1e-3);
  EXPECT_NEAR(number(summary, "mixing_start").value, 0.9 - 0.001 * 15.7 * 15.7, 1e-3);
}

/// True if one of the remarks contains these words.
bool remarks(const NamedNumbers& summary, const std::string& words)
{
  return std::ranges::any_of(summary.remarks, [&](const std::string& remark) {
    return remark.find(words) != std::string::npos;
  });
}

// y_L approaches 0.25 m.
TEST(SegregationTimes, AnEndAboveTheSurfaceIsRefused)
{
  auto states = history(1000, 1e-5);
  for (auto& now : states) now.bed = 0.2;
  const auto summary = segregation_times(states, std::vector<std::size_t>(40, 25));
  EXPECT_TRUE(std::isnan(number(summary, "y_L_end[m]").value));
  EXPECT_TRUE(remarks(summary, "it would end outside the bed"));
}

TEST(SegregationTimes, AnIndexAboveARandomMixtureIsRemarked)
{
  auto states = history(1000, 1e-5);
  const std::vector<std::size_t> windows(40, 25);
  EXPECT_FALSE(remarks(segregation_times(states, windows), "above 1"));
  for (auto& now : states) now.mixing += 0.2;
  EXPECT_TRUE(remarks(segregation_times(states, windows), "mixing_most: above 1"));
}

TEST(SegregationTimes, ARunThatEndsTooEarlySaysSo)
{
  const auto states = history(200, 1e-5);
  const auto summary = segregation_times(states, std::vector<std::size_t>(8, 25));
  EXPECT_TRUE(std::isnan(number(summary, "t90_strain").value));
  EXPECT_TRUE(std::isnan(number(summary, "t_mixing[s]").value));
  ASSERT_GE(summary.remarks.size(), 2u);
  EXPECT_NE(summary.remarks.back().find("largest in the last window"), std::string::npos);
  const auto tiny = segregation_times({states.begin(), states.begin() + 5}, {5});
  EXPECT_TRUE(std::isnan(number(tiny, "tau[s]").value));
  EXPECT_EQ(
      tiny.remarks[0],
      "no exponential approach fits y_L over time: it has too few frames; try a longer run or "
      "another --begin");
}

}  // namespace
}  // namespace grseg
