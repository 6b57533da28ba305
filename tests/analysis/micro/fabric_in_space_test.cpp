// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/fabric.hpp"
#include "tests/analysis/grain_builder.hpp"

#include <gsl/gsl_integration.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace grseg {
namespace {

constexpr double pi = std::numbers::pi;

/// Contacts whose branches have length 1.
struct SpaceContacts {
  FabricSums<3> fabric;
  double number = 0, force = 0;
  Tensor3 stress = Tensor3::Zero();

  /// Adds `weight` contacts with normal n.
  void add(const Vec3& n, double f_n, const Vec3& f_t = Vec3::Zero(), double weight = 1)
  {
    FabricSums<3> one;
    one.add(n, f_n, f_t);
    fabric.normal += weight * one.normal;
    fabric.normal_force += weight * one.normal_force;
    fabric.tangential_force += weight * one.tangential_force;
    number += weight;
    force += weight * f_n;
    stress += weight * (f_n * n + f_t) * n.transpose();
  }
  Anisotropy<3> anisotropy() const { return grseg::anisotropy(fabric, number, force); }
  double stress_ratio() const
  {
    const auto principal = principal_stress(stress);
    return principal.q / principal.p;
  }
};

/// Calls use(n, weight) with directions and weights that integrate polynomials in n up to degree
/// fifteen exactly over the sphere.
template <class Use>
void for_each_direction(const Use& use)
{
  constexpr int around = 16;
  const std::unique_ptr<gsl_integration_glfixed_table, void (*)(gsl_integration_glfixed_table*)>
      table(gsl_integration_glfixed_table_alloc(8), gsl_integration_glfixed_table_free);
  for (std::size_t k = 0; k < 8; ++k) {
    double z = 0, weight = 0;
    gsl_integration_glfixed_point(-1, 1, k, &z, &weight, table.get());
    for (int m = 0; m < around; ++m) {
      const double angle = 2 * pi * m / around, r = std::sqrt(1 - z * z);
      use(Vec3(r * std::cos(angle), r * std::sin(angle), z), weight / around);
    }
  }
}

/// Contacts and forces distributed as in Ouadfel & Rothenburg, with these deviators.
SpaceContacts second_order(const Tensor3& c, const Tensor3& n, const Tensor3& t, double f_0)
{
  SpaceContacts contacts;
  for_each_direction([&](const Vec3& direction, double weight) {
    const Vec3 along = t * direction;
    const Vec3 f_t = f_0 * (along - along.dot(direction) * direction);
    contacts.add(direction, f_0 * (1 + direction.dot(n * direction)), f_t,
                 weight * (1 + direction.dot(c * direction)));
  });
  return contacts;
}

/// Deviator with these principal values (the third follows), on axes turned by the angles (degrees)
/// about z and x.
Tensor3 deviator_on(double first, double second, double about_z, double about_x)
{
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(about_z * pi / 180, Vec3::UnitZ()) *
                                Eigen::AngleAxisd(about_x * pi / 180, Vec3::UnitX()))
                                   .toRotationMatrix();
  return turn * Vec3(first, second, -first - second).asDiagonal() * turn.transpose();
}

double size_of(const Tensor3& a)
{
  return std::sqrt(1.5 * a.cwiseProduct(a).sum());
}

TEST(FabricInSpace, ContactsInAllDirectionsAlikeAreIsotropic)
{
  const Tensor3 none = Tensor3::Zero();
  const auto contacts = second_order(none, none, none, 3);
  const auto a = contacts.anisotropy();
  EXPECT_NEAR(a.a_c, 0, 1e-14);
  EXPECT_NEAR(a.a_n, 0, 1e-14);
  EXPECT_NEAR(a.a_t, 0, 1e-14);
  EXPECT_NEAR(contacts.stress_ratio(), 0, 1e-14);
}

// Six equal contacts: <n n> = I/3, so q/p = (f_1 - f_2)/((f_1 + 2 f_2)/3) comes from the normal
// forces alone: 15/2 of the deviator of (f_1, f_2, f_2)/(f_1 + 2 f_2).
TEST(FabricInSpace, AnAxiallyLoadedCubicLatticeIsAnisotropicInItsNormalForcesAlone)
{
  SpaceContacts contacts;
  contacts.add(Vec3::UnitX(), 1);
  contacts.add(Vec3::UnitY(), 3);
  contacts.add(Vec3::UnitZ(), 1);
  const auto a = contacts.anisotropy();
  EXPECT_NEAR(a.a_c, 0, 1e-14);
  EXPECT_NEAR(a.a_n, 7.5 * 2 / 5, 1e-13);
  EXPECT_NEAR(a.a_t, 0, 1e-14);
  EXPECT_NEAR(contacts.stress_ratio(), 2 / (5.0 / 3), 1e-14);
  EXPECT_NEAR(a.rothenburg(), 0.4 * 3, 1e-13);
  EXPECT_NEAR(std::abs(major_axis(a.n).y()), 1, 1e-14);
}

TEST(FabricInSpace, AKnownDistributionIsRecoveredWhateverItsSizeAndDirections)
{
  struct Known {
    Tensor3 c, n, t;
  };
  for (const auto& known :
       {Known{deviator_on(0.4, -0.1, 40, 10), deviator_on(0.3, 0, 50, -20),
              deviator_on(0.1, 0.05, 35, 5)},
        Known{deviator_on(0.8, 0.1, 10, 80), deviator_on(0.9, -0.2, 70, 30),
              deviator_on(0.5, 0, 100, 45)},
        Known{deviator_on(0.02, 0, 0, 0), deviator_on(-0.9, 0.4, 0, 60), Tensor3::Zero()}}) {
    const auto a = second_order(known.c, known.n, known.t, 7).anisotropy();
    EXPECT_TRUE(same(a.c, known.c, 1e-12)) << a.c;
    EXPECT_TRUE(same(a.n, known.n, 1e-12)) << a.n;
    EXPECT_TRUE(same(a.t, known.t, 1e-12)) << a.t;
    EXPECT_NEAR(std::abs(a.a_c), size_of(known.c), 1e-12);
    EXPECT_NEAR(std::abs(a.a_n), size_of(known.n), 1e-12);
    EXPECT_NEAR(std::abs(a.a_t), size_of(known.t), 1e-12);
  }
}

// Guo & Zhao (2013): chi^n and chi^t are means over directions of f_n n n and f_t n. From contacts they are
// computed with a division by 1 + n.c.n; f_0 = tr chi^n, a^n = 15/2 chi^n'/f_0, a^t = 15/3 chi^t'/f_0.
TEST(FabricInSpace, TheForcesAnisotropiesAreThoseOfMeansOverDirections)
{
  const Tensor3 c = deviator_on(0.5, -0.1, 40, 10), n = deviator_on(0.4, 0.1, 60, -20);
  const Tensor3 t = deviator_on(0.2, 0, 35, 15);
  Tensor3 chi_n = Tensor3::Zero(), chi_t = Tensor3::Zero();
  for_each_direction([&](const Vec3& direction, double weight) {
    const Vec3 f_t = t * direction - direction.dot(t * direction) * direction;
    chi_n +=
        weight / 2 * 5 * (1 + direction.dot(n * direction)) * direction * direction.transpose();
    chi_t += weight / 2 * 5 * f_t * direction.transpose();
  });
  const double f_0 = chi_n.trace();
  const auto a = second_order(c, n, t, 5).anisotropy();
  EXPECT_TRUE(same(a.n, 7.5 * (chi_n - f_0 / 3 * Tensor3::Identity()) / f_0, 1e-12));
  EXPECT_TRUE(same(a.t, 5 * chi_t / f_0, 1e-12));
}

TEST(FabricInSpace, AnisotropiesMakeUpTheStressOfEquallyLongBranches)
{
  const auto contacts = second_order(deviator_on(0.8, 0.1, 10, 80), deviator_on(0.9, -0.2, 70, 30),
                                     deviator_on(0.5, 0, 100, 45), 7);
  EXPECT_NEAR(contacts.anisotropy().stress_ratio(), contacts.stress_ratio(), 1e-12);
}

// Arbitrary contacts, not only that distribution: the three expansions have the same second moments.
TEST(FabricInSpace, TheStressOfEquallyLongBranchesFollowsForAnyForces)
{
  std::mt19937 random(3);
  std::normal_distribution<double> any(0, 1);
  SpaceContacts contacts;
  for (int k = 0; k < 400; ++k) {
    const Vec3 n = Vec3(any(random), 1.5 * any(random), 0.8 * any(random)).normalized();
    const Vec3 f(any(random), any(random), any(random));
    contacts.add(n, 2 + f.x(), 0.3 * (f - f.dot(n) * n));
  }
  EXPECT_NEAR(contacts.anisotropy().stress_ratio(), contacts.stress_ratio(), 1e-12);
  EXPECT_GT(contacts.stress_ratio(), 0.1);
}

// q/p = 2/5 (a_c + a_n + 3/2 a_t), to second order in the anisotropies.
TEST(FabricInSpace, SmallAnisotropiesOfOneDirectionAddUpToTheStressRatio)
{
  const Tensor3 one = deviator_on(1, -0.4, 25, 65);
  const auto contacts = second_order(0.02 * one, 0.01 * one, 0.005 * one, 1);
  const auto a = contacts.anisotropy();
  EXPECT_NEAR(a.rothenburg(), 0.4 * (0.02 + 0.01 + 1.5 * 0.005) * size_of(one), 1e-12);
  EXPECT_NEAR(contacts.stress_ratio(), a.rothenburg(), 2e-3 * a.rothenburg());
  EXPECT_NEAR(std::abs(principal_stress(contacts.stress).major.dot(major_axis(one))), 1, 1e-12);
}

TEST(FabricInSpace, AnAnisotropyThatOpposesTheStressIsNegative)
{
  const Tensor3 one = deviator_on(1, -0.5, 25, 65);
  const auto a = second_order(0.3 * one, -0.1 * one, -0.02 * one, 1).anisotropy();
  EXPECT_NEAR(a.a_c, 0.3 * size_of(one), 1e-12);
  EXPECT_NEAR(a.a_n, -0.1 * size_of(one), 1e-12);
  EXPECT_NEAR(a.a_t, -0.02 * size_of(one), 1e-12);
}

TEST(FabricInSpace, OneContactIsFullyAnisotropicAndNoDensity)
{
  SpaceContacts contacts;
  contacts.add(Vec3(1, 2, 2) / 3, 1);
  const auto a = contacts.anisotropy();
  EXPECT_NEAR(a.a_c, 7.5, 1e-13);
  EXPECT_TRUE(std::isnan(a.a_n));
  EXPECT_TRUE(std::isnan(a.a_t));
  EXPECT_NEAR(contacts.stress_ratio(), 3, 1e-13);
  EXPECT_TRUE(std::isnan(SpaceContacts().anisotropy().a_c));
}

// Each n n has a deviator of square 2/3: <a_c^2> = (15/2)^2 3/2 2/3 /N.
TEST(FabricInSpace, ContactsInRandomDirectionsSeemAnisotropicByTheirNumber)
{
  std::mt19937 random(8);
  std::normal_distribution<double> any(0, 1);
  double squares = 0;
  for (int sample = 0; sample < 400; ++sample) {
    SpaceContacts contacts;
    for (int k = 0; k < 225; ++k)
      contacts.add(Vec3(any(random), any(random), any(random)).normalized(), 1);
    squares += std::pow(contacts.anisotropy().a_c, 2) / 400;
  }
  EXPECT_NEAR(std::sqrt(squares), 0.5, 0.025);  // 7.5/sqrt(225); error 1/sqrt(2 5 400) of it
}

TEST(FabricInSpace, PrincipalStressesAreThoseOfTheSymmetricPart)
{
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.3, Vec3::UnitZ()) * Eigen::AngleAxisd(1.1, Vec3::UnitX()))
          .toRotationMatrix();
  Tensor3 skew;
  skew << 0, 4, -1, -4, 0, 2, 1, -2, 0;
  const Tensor3 stress = turn * Vec3(1, 5, 2).asDiagonal() * turn.transpose() + skew;
  const auto principal = principal_stress(stress);
  EXPECT_NEAR(principal.p, 8.0 / 3, 1e-14);
  EXPECT_NEAR(principal.q, std::sqrt(13), 1e-13);  // (4^2 + 3^2 + 1)/2
  EXPECT_NEAR(principal.b, 0.25, 1e-13);
  EXPECT_NEAR(std::abs(principal.major.dot(turn.col(1))), 1, 1e-14);
}

TEST(FabricInSpace, AnAxisHasOnePairOfAnglesWhicheverWayItPoints)
{
  for (const double sign : {1, -1}) {
    const auto angles = axis_angles(sign * Vec3(-1, 1, 1));
    EXPECT_NEAR(angles.theta, 135, 1e-12);
    EXPECT_NEAR(angles.tilt, std::asin(1 / std::sqrt(3)) * 180 / pi, 1e-12);
    EXPECT_NEAR(axis_angles(sign * Vec3(1, 0, -1)).theta, 0, 1e-12);
    EXPECT_NEAR(axis_angles(sign * Vec3(1, 0, -1)).tilt, -45, 1e-12);
  }
}

}  // namespace
}  // namespace grseg
