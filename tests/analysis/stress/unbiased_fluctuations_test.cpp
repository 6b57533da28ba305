// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/kinetic_stress.hpp"
#include "tests/analysis/grain_builder.hpp"
#include "tests/analysis/stress/kinetic_of_frames.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace grseg {
namespace {

using std::numbers::pi;

const Layers unit_layers(1, 10);

KineticStress<2> kinetic(const std::vector<Packing>& frames, MeanFlow flow)
{
  return kinetic_of(frames, flow, 0.5);
}

/// Grains of different masses in one layer that move and rotate at random.
template <int D>
PackingOf<D> cloud(int grains)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&](auto v) {
    for (auto& component : v) component = number(random);
    return v;
  };
  PackingOf<D> packing;
  for (int g = 0; g < grains; ++g) {
    Vector<D> position = Vector<D>::Constant(0.5);
    Spin<D> spin;
    if constexpr (D == 2)
      spin = number(random);
    else
      spin = vector(Vec3{});
    packing.grain(g % 2 == 0 ? Species::small : Species::large, 0.1 * (1.5 + number(random)),
                  position, 3 * Vector<D>::Ones() + vector(Vector<D>{}), spin);
  }
  return packing;
}

/// Fluctuation of grain i by its definition, pair by pair.
template <int D>
typename UnbiasedFluctuations<D>::Product pair_by_pair(const PackingOf<D>& packing, std::size_t i)
{
  const auto& [grains, frame] = packing;
  typename UnbiasedFluctuations<D>::Product sum;
  double weights = 0;
  for (std::size_t j = 0; j < grains.size(); ++j)
    for (std::size_t k = 0; k < grains.size(); ++k) {
      if (i == j || i == k || j == k) continue;
      const double weight = grains.mass[j] * grains.mass[k];
      const Vector<D> from_j = frame.velocity[i] - frame.velocity[j],
                      from_k = frame.velocity[i] - frame.velocity[k];
      const Spin<D> spin_j = frame.angular_velocity[i] - frame.angular_velocity[j],
                    spin_k = frame.angular_velocity[i] - frame.angular_velocity[k];
      weights += weight;
      sum.velocities += weight * from_j * from_k.transpose();
      if constexpr (D == 2)
        sum.spins += weight * spin_j * spin_k;
      else
        sum.spins += weight * spin_j.dot(spin_k);
    }
  return {sum.velocities / weights, sum.spins / weights};
}

template <int D>
void expect_the_definition(const Layers& layers, int grains)
{
  const auto packing = cloud<D>(grains);
  const UnbiasedFluctuations<D> fluctuations(layers, packing.grains, packing.frame);
  for (std::size_t g = 0; g < packing.grains.size(); ++g) {
    const auto found =
        fluctuations.of(0, packing.grains.mass[g], motion_of<D>(layers, packing.frame, g));
    const auto expected = pair_by_pair(packing, g);
    EXPECT_TRUE(same(found.velocities, expected.velocities, 1e-13)) << g;
    EXPECT_NEAR(found.spins, expected.spins, 1e-13) << g;
  }
}

TEST(UnbiasedFluctuations, AGrainIsComparedWithEveryPairOfOthers)
{
  for (const int grains : {3, 4, 11}) {
    expect_the_definition<2>(unit_layers, grains);
    expect_the_definition<3>(Layers(1, 10, 10), grains);
  }
}

/// Mean and variance of a quadratic form v A v of independent normal numbers v of mean 0 and
/// variances s: tr(A S) and 2 tr(A S A S), with S = diag(s) and A symmetric.
struct NormalForm {
  Eigen::MatrixXd a;
  Eigen::VectorXd s;

  double expectation() const { return a.diagonal().dot(s); }
  double variance() const
  {
    const Eigen::MatrixXd as = a * s.asDiagonal();
    return 2 * (as * as).trace();
  }
};

/// Two heavy grains among nine light ones. The variances of a velocity component are neither equal
/// nor proportional to 1/mass.
struct Mixture {
  static constexpr int heavy = 2, all = 11;
  static constexpr double heavy_mass = 8, heavy_variance = 0.3, light_variance = 1;

  static double mass(int g) { return g < heavy ? heavy_mass : 1; }
  static double variance(int g) { return g < heavy ? heavy_variance : light_variance; }
  static constexpr double total = heavy * heavy_mass + (all - heavy);

  static Packing drawn(std::mt19937& random)
  {
    std::normal_distribution<double> kick(0, 1);
    Packing packing;
    for (int g = 0; g < all; ++g)
      packing.grain(g < heavy ? Species::large : Species::small, std::sqrt(mass(g) / pi),
                    {0.1, 0.5}, {7 + std::sqrt(variance(g)) * kick(random), 0});
    return packing;
  }

  /// sum m dv^2 of the grains from `begin` to `end` as a quadratic form in the velocities: from the
  /// differences v_i - v_j of all pairs of others with weights m_j (`unbiased`), or from v_i - V.
  static NormalForm form(int begin, int end, bool unbiased)
  {
    NormalForm form{Eigen::MatrixXd::Zero(all, all), Eigen::VectorXd(all)};
    for (int g = 0; g < all; ++g) form.s[g] = variance(g);
    const auto unit = [](int g) { return Eigen::VectorXd(Eigen::VectorXd::Unit(all, g)); };
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(all);
    for (int g = 0; g < all; ++g) mean += mass(g) / total * unit(g);
    for (int i = begin; i < end; ++i) {
      Eigen::MatrixXd own = Eigen::MatrixXd::Zero(all, all);
      double weights = 0;
      for (int j = 0; j < all; ++j)
        for (int k = 0; k < all; ++k) {
          if (i == j || i == k || j == k) continue;
          weights += mass(j) * mass(k);
          own += mass(j) * mass(k) * (unit(i) - unit(j)) * (unit(i) - unit(k)).transpose();
        }
      own /= weights;
      if (!unbiased) own = (unit(i) - mean) * (unit(i) - mean).transpose();
      form.a += mass(i) * (own + own.transpose()) / 2;
    }
    return form;
  }
};

// The tolerance is four standard errors, sqrt(var/N) for N = 20000 frames. `instant` differs from
// the truth by the closed form: m s (1 - 2 m/M) + m sum m_j^2 s_j/M^2 for one grain.
TEST(UnbiasedFluctuations, HeavyGrainsAmongLightOnesHaveTheVarianceTheyWereDrawnWith)
{
  constexpr int frames = 20000;
  std::mt19937 random(1);
  std::vector<Packing> drawn;
  for (int f = 0; f < frames; ++f) drawn.push_back(Mixture::drawn(random));
  const auto unbiased = kinetic(drawn, MeanFlow::instant_unbiased),
             instant = kinetic(drawn, MeanFlow::instant);

  double of_mean = 0;  // variance of V
  for (int g = 0; g < Mixture::all; ++g)
    of_mean += std::pow(Mixture::mass(g) / Mixture::total, 2) * Mixture::variance(g);
  for (const auto species : {Species::large, Species::small}) {
    const bool heavy = species == Species::large;
    const int begin = heavy ? 0 : Mixture::heavy, end = heavy ? Mixture::heavy : Mixture::all;
    const double mass = Mixture::mass(begin), variance = Mixture::variance(begin),
                 number = end - begin, truth = number * mass * variance,
                 biased = number * mass * (variance * (1 - 2 * mass / Mixture::total) + of_mean);
    const auto form = Mixture::form(begin, end, true),
               biased_form = Mixture::form(begin, end, false);
    EXPECT_NEAR(form.expectation(), truth, 1e-12);
    EXPECT_NEAR(biased_form.expectation(), biased, 1e-12);
    const double error = std::sqrt(form.variance() / frames),
                 biased_error = std::sqrt(biased_form.variance() / frames);
    EXPECT_NEAR(unbiased.mean(0, species).about_mean.kinetic(0, 0), truth, 4 * error);
    EXPECT_NEAR(instant.mean(0, species).about_mean.kinetic(0, 0), biased, 4 * biased_error);
    // For a light grain, the part that its own mass removes and the part that heavy grains add
    // nearly cancel.
    if (heavy) {
      EXPECT_GT(truth - biased, 20 * biased_error);
    }
  }
}

// sum m (v - V)^2/(m s) of n equal grains is chi squared with n - 1 degrees of freedom: the mean is
// n - 1, and the standard error of N frames is sqrt(2 (n - 1)/N).
TEST(UnbiasedFluctuations, OfEqualGrainsTheMeanOfTheFrameTakesOneInNAway)
{
  constexpr int n = 5, frames = 4000;
  constexpr double mass = pi * 0.01, variance = 0.7;
  std::mt19937 random(2);
  std::normal_distribution<double> kick(0, std::sqrt(variance));
  std::vector<Packing> drawn(frames);
  for (auto& packing : drawn)
    for (int g = 0; g < n; ++g)
      packing.grain(Species::small, 0.1, {0.1, 0.5}, {-2, kick(random)}, kick(random));
  const auto unbiased =
                 kinetic(drawn, MeanFlow::instant_unbiased).mean(0, Species::small).about_mean,
             instant = kinetic(drawn, MeanFlow::instant).mean(0, Species::small).about_mean;
  const double truth = n * mass * variance, error = truth / n * std::sqrt(2.0 * (n - 1) / frames);
  EXPECT_NEAR(instant.kinetic(1, 1), (1 - 1.0 / n) * truth, 4 * error);
  EXPECT_NEAR(unbiased.kinetic(1, 1), truth, 4 * error * n / (n - 1));
  EXPECT_NEAR(unbiased.kinetic(1, 1), instant.kinetic(1, 1) * n / (n - 1), 1e-14);
  EXPECT_NEAR(unbiased.rotational, instant.rotational * n / (n - 1), 1e-16);
  EXPECT_GT(truth - (1 - 1.0 / n) * truth, 20 * error);
}

// The common motion of the other grains cannot be estimated from one other grain, or from none.
TEST(UnbiasedFluctuations, GrainsWithFewerThanTwoOthersDoNotCountButAreCounted)
{
  Packing packing;
  packing.grain(Species::large, 0.1, {1, 2.5}, {9, 0});  // the only grain of its layer
  packing.grain(Species::small, 0.1, {1, 1.5}, {5, 0});  // two grains in this layer
  packing.grain(Species::large, 0.1, {2, 1.5}, {7, 0});
  packing.grain(Species::small, 0.1, {1, 0.5}, {1, 0});  // three grains in this layer
  packing.grain(Species::small, 0.1, {2, 0.5}, {2, 0});
  packing.grain(Species::small, 0.1, {3, 0.5}, {4, 0});
  packing.grain(Species::boundary, 0.1, {1, 0});  // boundary grains do not count
  const auto stress = kinetic({packing}, MeanFlow::instant_unbiased);
  const auto alone = stress.mean(2, Species::large), one_of_two = stress.mean(1, Species::small),
             three = stress.mean(0, Species::small);
  EXPECT_EQ(alone.left_out, 1);
  EXPECT_EQ(one_of_two.left_out, 1);
  for (const auto& mean : {alone, one_of_two}) {
    EXPECT_EQ(mean.grains, 0);
    EXPECT_EQ(mean.mass, 0);
    EXPECT_EQ(mean.about_mean.kinetic.norm(), 0);
    EXPECT_TRUE(std::isnan(mean.temperature()[0]));
  }
  EXPECT_EQ(stress.flow(2).u, 9);
  EXPECT_EQ(stress.flow(1).u, 6);
  EXPECT_EQ(three.left_out, 0);
  EXPECT_EQ(three.grains, 3);
  // (1 - 2)(1 - 4) + (2 - 1)(2 - 4) + (4 - 1)(4 - 2), times the mass.
  EXPECT_NEAR(three.about_mean.kinetic(0, 0), pi * 0.01 * 7, 1e-15);
  for (const auto flow : {MeanFlow::profile, MeanFlow::layer, MeanFlow::instant, MeanFlow::species})
    EXPECT_EQ(kinetic({packing}, flow).mean(2, Species::large).left_out, 0);
}

}  // namespace
}  // namespace grseg
