// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/fabric.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace grseg {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;

Vec2 direction(double degrees)
{
  return {std::cos(degrees * degree), std::sin(degrees * degree)};
}

/// Contacts with branches of length 1, by direction.
struct Contacts {
  FabricSums<2> fabric;
  double number = 0, force = 0;
  Tensor2 stress = Tensor2::Zero();

  /// Adds `weight` contacts whose normal is at `degrees`.
  void add(double degrees, double f_n, double f_t = 0, double weight = 1)
  {
    const Vec2 n = direction(degrees), t{-n.y(), n.x()};
    FabricSums<2> one;
    one.add(n, f_n, f_t);
    fabric.normal += weight * one.normal;
    fabric.normal_force += weight * one.normal_force;
    fabric.tangential_force += weight * one.tangential_force;
    number += weight;
    force += weight * f_n;
    stress += weight * (f_n * n + f_t * t) * n.transpose();
  }
  Anisotropy<2> anisotropy() const { return grseg::anisotropy(fabric, number, force); }
  double stress_ratio() const
  {
    const auto principal = principal_stress(stress);
    return principal.q / principal.p;
  }
};

TEST(Fabric, AHexagonalPackingOfEqualDiscsIsIsotropicInItsSecondMoment)
{
  Contacts contacts;
  for (const double angle : {10.0, 70.0, 130.0}) contacts.add(angle, 2);
  const auto a = contacts.anisotropy();
  EXPECT_NEAR(a.a_c, 0, 1e-15);
  EXPECT_NEAR(a.a_n, 0, 1e-15);
  EXPECT_NEAR(a.a_t, 0, 1e-15);
  EXPECT_NEAR(contacts.stress_ratio(), 0, 1e-15);
}

// q/p = (f_x - f_y)/(f_x + f_y) comes from the normal forces alone.
TEST(Fabric, ABiaxiallyLoadedSquareLatticeIsAnisotropicInItsNormalForcesAlone)
{
  Contacts contacts;
  contacts.add(0, 3);
  contacts.add(90, 1);
  const auto a = contacts.anisotropy();
  EXPECT_NEAR(a.a_c, 0, 1e-15);
  EXPECT_NEAR(a.a_n, 1, 1e-15);
  EXPECT_NEAR(a.a_t, 0, 1e-15);
  EXPECT_NEAR(std::sin(a.theta_n * degree), 0, 1e-15);
  EXPECT_NEAR(contacts.stress_ratio(), 0.5, 1e-15);
  EXPECT_NEAR(a.rothenburg(), 0.5, 1e-15);
}

TEST(Fabric, OneContactIsFullyAnisotropicAndNoDensity)
{
  Contacts contacts;
  contacts.add(30, 1);
  const auto a = contacts.anisotropy();
  EXPECT_NEAR(a.a_c, 2, 1e-15);
  EXPECT_NEAR(a.theta_c, 30, 1e-13);
  EXPECT_TRUE(std::isnan(a.a_n));
  EXPECT_TRUE(std::isnan(a.a_t));
  EXPECT_NEAR(contacts.stress_ratio(), 1, 1e-15);
}

TEST(Fabric, WithoutContactsThereIsNoAnisotropy)
{
  EXPECT_TRUE(std::isnan(Contacts().anisotropy().a_c));
}

/// The second-harmonic distribution of Rothenburg & Bathurst in 360 directions.
Contacts second_harmonic(const Anisotropy<2>& a, double f_0)
{
  Contacts contacts;
  for (int k = 0; k < 360; ++k) {
    const double theta = k / 2.0;
    contacts.add(theta, f_0 * (1 + a.a_n * std::cos(2 * (theta - a.theta_n) * degree)),
                 -f_0 * a.a_t * std::sin(2 * (theta - a.theta_t) * degree),
                 1 + a.a_c * std::cos(2 * (theta - a.theta_c) * degree));
  }
  return contacts;
}

TEST(Fabric, AKnownDistributionIsRecoveredWhateverItsSizeAndDirections)
{
  for (const Anisotropy<2> known :
       {Anisotropy<2>{0.4, 0.3, 0.1, 135, 130, 140}, Anisotropy<2>{0.9, 0.8, 0.5, 20, 75, 160},
        Anisotropy<2>{0.05, 0.9, 0.3, 0.5, 179, 90}}) {
    const auto a = second_harmonic(known, 7).anisotropy();
    EXPECT_NEAR(a.a_c, known.a_c, 1e-12);
    EXPECT_NEAR(a.a_n, known.a_n, 1e-12);
    EXPECT_NEAR(a.a_t, known.a_t, 1e-12);
    EXPECT_NEAR(a.theta_c, known.theta_c, 1e-9);
    EXPECT_NEAR(a.theta_n, known.theta_n, 1e-9);
    EXPECT_NEAR(a.theta_t, known.theta_t, 1e-9);
  }
}

TEST(Fabric, AnisotropiesMakeUpTheStressOfEquallyLongBranches)
{
  const Anisotropy<2> known{0.9, 0.8, 0.5, 20, 75, 160};
  const auto contacts = second_harmonic(known, 7);
  EXPECT_NEAR(contacts.stress_ratio(), contacts.anisotropy().stress_ratio(), 1e-12);
}

// Rothenburg & Bathurst: q/p = (a_c + a_n + a_t)/2, to second order in the anisotropies.
TEST(Fabric, SmallAnisotropiesOfOneDirectionAddUpToTheStressRatio)
{
  const auto contacts = second_harmonic({0.02, 0.01, 0.005, 135, 135, 135}, 1);
  EXPECT_NEAR(contacts.anisotropy().rothenburg(), 0.0175, 1e-12);
  EXPECT_NEAR(contacts.stress_ratio(), 0.0175, 0.0175 * 0.02 * 0.01);
  EXPECT_NEAR(principal_stress(contacts.stress).theta, 135, 1e-9);
}

TEST(Fabric, PrincipalStressesAreThoseOfTheSymmetricPart)
{
  Tensor2 stress;
  stress << 3, 2, 0, 1;
  const auto principal = principal_stress(stress);
  EXPECT_NEAR(principal.p, 2, 1e-15);
  EXPECT_NEAR(principal.q, std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(principal.theta, 22.5, 1e-12);
}

}  // namespace
}  // namespace grseg
