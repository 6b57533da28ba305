// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/micro/fabric.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace grseg {
namespace {

using Complex = std::complex<double>;

Complex moment(const Vec2& sum, double number)
{
  return {sum.x() / number, sum.y() / number};
}

/// a exp(2 i theta), with theta in degrees.
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

// With A = a exp(2 i theta_0) for each of the three anisotropies, the moments of E, f_n and f_t are
//   <exp 2i theta>     = A_c/2
//   <f_n>              = f_0 (1 + Re(conj(A_c) A_n)/2)
//   <f_n exp 2i theta> = f_0 (A_c + A_n)/2
//   <f_t exp 2i theta> = -i f_0 A_t/2
// which is linear in 1/f_0, A_n and A_t for known A_c.
Anisotropy<2> anisotropy(const FabricSums<2>& sums, double contacts, double force)
{
  if (!(contacts > 0)) return {no_number, no_number, no_number, no_number, no_number, no_number};
  const Complex c = 2.0 * moment(sums.normal, contacts);
  const double a_c = std::abs(c), theta_c = axis(std::arg(c) / 2);
  if (a_c >= 1) return {a_c, no_number, no_number, theta_c, no_number, no_number};

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

// Anisotropies and principal stresses in three dimensions.

namespace {

Tensor3 symmetric(const Tensor3& tensor)
{
  return (tensor + tensor.transpose()) / 2;
}

Tensor3 deviator(const Tensor3& tensor)
{
  return tensor - tensor.trace() / 3 * Tensor3::Identity();
}

/// Size sqrt(3/2 a:a) of a deviator a.
double size(const Tensor3& a)
{
  return std::sqrt(1.5) * a.norm();
}

double inner(const Tensor3& a, const Tensor3& b)
{
  return a.cwiseProduct(b).sum();
}

/// Mean of m m (m.a.m) (m.b.m) over all directions m, for deviators a and b.
Tensor3 mean_of_fourfold(const Tensor3& a, const Tensor3& b)
{
  const Tensor3 ab = a * b;
  return (2 * ab.trace() * Tensor3::Identity() + 4 * (ab + ab.transpose())) / 105;
}

/// The moment <f_n m m>/f_0 for scale = 1. It is linear in (scale, n).
Tensor3 normal_moment(const Tensor3& c, double scale, const Tensor3& n)
{
  return scale * (Tensor3::Identity() / 3 + 2.0 / 15 * c) + 2.0 / 15 * n + mean_of_fourfold(c, n);
}

/// The symmetric part of the moment <f_t m>/f_0, whose trace is 0.
Tensor3 tangential_moment(const Tensor3& c, const Tensor3& t)
{
  return t / 5 + 2.0 / 15 * symmetric(t * c) - mean_of_fourfold(c, t);
}

using Six = Eigen::Matrix<double, 6, 1>;

Six components(const Tensor3& a)
{
  Six six;
  six << a(0, 0), a(1, 1), a(2, 2), a(0, 1), a(0, 2), a(1, 2);
  return six;
}

/// Unknowns of a linear equation: a number and a deviator.
struct Expansion {
  double scale = 0;
  Tensor3 deviator = Tensor3::Zero();
};

/// The expansion e with moment(e) = `measured`, for a linear `moment` with symmetric tensors.
template <class Moment>
Expansion expansion_of(const Tensor3& measured, const Moment& moment)
{
  std::array<Expansion, 6> basis{};
  basis[0].scale = 1;
  for (const Eigen::Index k : {0, 1}) {
    basis[static_cast<std::size_t>(k) + 1].deviator(k, k) = 1;
    basis[static_cast<std::size_t>(k) + 1].deviator(2, 2) = -1;
    basis[static_cast<std::size_t>(k) + 4].deviator(k, 2) = 1;
    basis[static_cast<std::size_t>(k) + 4].deviator(2, k) = 1;
  }
  basis[3].deviator(0, 1) = basis[3].deviator(1, 0) = 1;
  Eigen::MatrixXd matrix(6, 6);  // for a fixed size, g++ 16 warns that Eigen's loops exceed it
  for (Eigen::Index k = 0; k < 6; ++k)
    matrix.col(k) = components(moment(basis[static_cast<std::size_t>(k)]));
  const Eigen::VectorXd solution = matrix.colPivHouseholderQr().solve(components(measured));
  Expansion sum;
  for (Eigen::Index k = 0; k < 6; ++k) {
    const auto& part = basis[static_cast<std::size_t>(k)];
    sum.scale += solution[k] * part.scale;
    sum.deviator += solution[k] * part.deviator;
  }
  return sum;
}

}  // namespace

// <m m> = I/3 + 2/15 c gives c. <f_n m m> and <f_t m> (normal_moment(), tangential_moment()) are
// linear in f_0, f_0 n and f_0 t for known c.
Anisotropy<3> anisotropy(const FabricSums<3>& sums, double contacts, double)
{
  const Tensor3 unknown = Tensor3::Constant(no_number);
  if (!(contacts > 0)) return {unknown, unknown, unknown, no_number, no_number, no_number};
  const Tensor3 c = 7.5 * deviator(sums.normal / contacts);
  const Tensor3 forces = sums.normal_force / contacts;
  const Tensor3 tangential = symmetric(sums.tangential_force / contacts);
  const Tensor3 stress = deviator(forces + tangential);
  const auto signed_size = [&](const Tensor3& a) {
    return inner(a, stress) < 0 ? -size(a) : size(a);
  };
  const Eigen::SelfAdjointEigenSolver<Tensor3> solver(c, Eigen::EigenvaluesOnly);
  if (solver.eigenvalues()[0] <= -1)
    return {c, unknown, unknown, signed_size(c), no_number, no_number};

  const auto normal = expansion_of(
      forces, [&](const Expansion& of) { return normal_moment(c, of.scale, of.deviator); });
  const double f_0 = normal.scale;
  const auto sliding = expansion_of(tangential, [&](const Expansion& of) -> Tensor3 {
    return of.scale * Tensor3::Identity() + tangential_moment(c, of.deviator);
  });
  const Tensor3 n = normal.deviator / f_0, t = sliding.deviator / f_0;
  return {c, n, t, signed_size(c), signed_size(n), signed_size(t)};
}

double Anisotropy<3>::stress_ratio() const
{
  const Tensor3 stress = normal_moment(c, 1, n) + tangential_moment(c, t);
  return 3 * size(deviator(stress)) / stress.trace();
}

PrincipalStress<3> principal_stress(const Tensor3& stress)
{
  const Tensor3 even = symmetric(stress);
  const Eigen::SelfAdjointEigenSolver<Tensor3> solver(even);
  const Vec3& s = solver.eigenvalues();  // in increasing order
  return {s.sum() / 3, size(deviator(even)), ratio(s[1] - s[0], s[2] - s[0]),
          solver.eigenvectors().col(2)};
}

Vec3 major_axis(const Tensor3& tensor)
{
  if (!tensor.allFinite()) return Vec3::Constant(no_number);
  return principal_stress(tensor).major;
}

AxisAngles axis_angles(const Vec3& axis)
{
  const bool turned = axis.y() < 0 || (axis.y() == 0 && axis.x() < 0);
  const Vec3 one = (turned ? -1 : 1) * axis.normalized();
  const double degree = std::numbers::pi / 180;
  const double theta = std::fmod(std::atan2(one.y(), one.x()) / degree, 180.0);
  return {theta, std::atan2(one.z(), std::hypot(one.x(), one.y())) / degree};
}

}  // namespace grseg
