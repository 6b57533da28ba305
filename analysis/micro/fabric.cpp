// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/fabric.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace grseg {
namespace {

using Complex = std::complex<double>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Complex moment(const Vec2& sum, double number)
{
  return {sum.x() / number, sum.y() / number};
}

/// a exp(2 i theta), theta in degrees.
Complex twofold(double a, double theta)
{
  return std::polar(a, 2 * theta * std::numbers::pi / 180);
}

/// Direction in degrees, in [0, 180), of an axis at the angle theta in radians.
double axis(double theta)
{
  const double degrees = std::fmod(theta * 180 / std::numbers::pi, 180.0);
  return degrees < 0 ? degrees + 180 : degrees;
}

}  // namespace

template <>
void FabricSums<2>::add(const Vec2& n, double f_n, const double& f_t)
{
  const Vec2 twice{n.x() * n.x() - n.y() * n.y(), 2 * n.x() * n.y()};
  normal += twice;
  normal_force += f_n * twice;
  tangential_force += f_t * twice;
}

template <>
void FabricSums<3>::add(const Vec3& n, double f_n, const Vec3& f_t)
{
  const Tensor3 square = n * n.transpose();
  normal += square;
  normal_force += f_n * square;
  tangential_force += f_t * n.transpose();
}

template <int D>
FabricSums<D>& FabricSums<D>::operator+=(const FabricSums& others)
{
  normal += others.normal;
  normal_force += others.normal_force;
  tangential_force += others.tangential_force;
  return *this;
}

template struct FabricSums<2>;
template struct FabricSums<3>;

// With A = a exp(2 i theta_0) for each of the three, the moments of the expansions are
//   <exp 2i theta>     = A_c/2
//   <f_n>              = f_0 (1 + Re(conj(A_c) A_n)/2)
//   <f_n exp 2i theta> = f_0 (A_c + A_n)/2
//   <f_t exp 2i theta> = -i f_0 A_t/2
// which is linear in 1/f_0, A_n and A_t once A_c is known.
Anisotropy<2> anisotropy(const FabricSums<2>& sums, double contacts, double force)
{
  if (!(contacts > 0)) return {nan, nan, nan, nan, nan, nan};
  const Complex c = 2.0 * moment(sums.normal, contacts);
  const double a_c = std::abs(c), theta_c = axis(std::arg(c) / 2);
  if (a_c >= 1) return {a_c, nan, nan, theta_c, nan, nan};

  const Complex force_moment = moment(sums.normal_force, contacts);
  const double f_0 =
      (force / contacts - std::real(std::conj(c) * force_moment)) / (1 - a_c * a_c / 2);
  const Complex n = 2.0 * force_moment / f_0 - c;
  const Complex t = Complex(0, 2) * moment(sums.tangential_force, contacts) / f_0;
  return {a_c, std::abs(n), std::abs(t), theta_c, axis(std::arg(n) / 2), axis(std::arg(t) / 2)};
}

double Anisotropy<2>::stress_ratio() const
{
  const Complex c = twofold(a_c, theta_c), n = twofold(a_n, theta_n), t = twofold(a_t, theta_t);
  return std::abs(c + n + t) / (2 + std::real(std::conj(c) * n));
}

PrincipalStress<2> principal_stress(const Tensor2& stress)
{
  Eigen::SelfAdjointEigenSolver<Tensor2> solver;
  solver.computeDirect((stress + stress.transpose()) / 2);
  const Vec2 values = solver.eigenvalues(), direction = solver.eigenvectors().col(1);
  return {(values[1] + values[0]) / 2, (values[1] - values[0]) / 2,
          axis(std::atan2(direction.y(), direction.x()))};
}

}  // namespace grseg
