// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/late_damping.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

std::size_t row(std::int32_t index)
{
  return static_cast<std::size_t>(index);
}

/// n x v: in two dimensions the component of v along the tangent, a quarter turn to the left of n.
template <int D>
Spin<D> turn(const Vector<D>& n, const Vector<D>& v)
{
  if constexpr (D == 2)
    return v.dot(Vec2(-n.y(), n.x()));
  else
    return n.cross(v);
}

/// s x n: the vector along the tangents whose `turn` is s.
template <int D>
Vector<D> along_tangent(const Spin<D>& s, const Vector<D>& n)
{
  if constexpr (D == 2)
    return s * Vec2(-n.y(), n.x());
  else
    return s.cross(n);
}

double size(double spin)
{
  return std::abs(spin);
}
double size(const Vec3& spin)
{
  return spin.norm();
}

template <int D>
std::vector<Spin<D>> zero_spins(const Grains& grains)
{
  if constexpr (D == 2)
    return std::vector<double>(grains.size());
  else
    return std::vector<Vec3>(grains.size(), Vec3::Zero());
}

/// The force of a contact along its normal, and its `turn`.
template <int D>
struct Split {
  Vector<D> n;
  double normal;
  Spin<D> tangential;
};
template <int D>
Split<D> split(const ContactList<D>& contacts, std::size_t c)
{
  const Vector<D> n = contacts.branch[c].normalized();
  return {n, contacts.force[c].dot(n), turn<D>(n, contacts.force[c])};
}

template <int D>
std::vector<Spin<D>> angular_accelerations(const Grains& grains, const ContactList<D>& contacts,
                                           double inertia)
{
  auto acceleration = zero_spins<D>(grains);
  const auto add = [&](std::size_t g, const Spin<D>& tangential) {
    if (is_mobile(grains, g))
      acceleration[g] -= tangential / (inertia * grains.mass[g] * grains.radius[g]);
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Spin<D> tangential = split(contacts, c).tangential;
    add(row(contacts.i[c]), tangential);
    if (contacts.j[c] >= 0) add(row(contacts.j[c]), tangential);
  }
  return acceleration;
}

/// Largest ratio of friction to normal force: where it is reached, contacts slide.
template <int D>
double friction_of(const ContactList<D>& contacts)
{
  double largest = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto force = split(contacts, c);
    if (force.normal > 0) largest = std::max(largest, size(force.tangential) / force.normal);
  }
  return largest;
}

}  // namespace

template <int D>
LateDamping subtract_late_damping(const Grains& grains, const Frame<D>& frame, double step,
                                  double inertia, std::vector<Vector<D>>& defect)
{
  const auto& contacts = frame.contacts;
  const auto spin_up = angular_accelerations(grains, contacts, inertia);
  const double friction = friction_of(contacts);
  // The force that is missing on every grain per unit of c_n and of c_t.
  std::vector<Vector<D>> per_normal(grains.size(), Vector<D>::Zero()), per_tangential = per_normal;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = row(contacts.i[c]);
    const bool wall = contacts.j[c] < 0;
    const auto j = wall ? i : row(contacts.j[c]);
    const bool pair = !wall && is_mobile(grains, j);
    const double m = grains.mass[i];
    const double mass = pair ? m * grains.mass[j] / (m + grains.mass[j]) : m;
    const auto force = split(contacts, c);
    Vector<D> a = frame.force[i] / m;
    Spin<D> rims = grains.radius[i] * spin_up[i];
    if (pair) {
      a -= frame.force[j] / grains.mass[j];
      rims += grains.radius[j] * spin_up[j];
    }
    const bool slides = size(force.tangential) > 0.99 * friction * std::abs(force.normal);
    const Vector<D> along_n = -mass * step / 2 * a.dot(force.n) * force.n;
    Vector<D> along_t = Vector<D>::Zero();
    if (!slides)
      along_t = along_tangent<D>(-mass * step / 2 * (turn<D>(force.n, a) - rims), force.n);
    per_normal[i] += along_n;
    per_tangential[i] += along_t;
    if (!pair) continue;
    per_normal[j] -= along_n;
    per_tangential[j] -= along_t;
  }
  Eigen::Matrix2d products = Eigen::Matrix2d::Zero();
  Vec2 projections = Vec2::Zero();
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!is_mobile(grains, frame, g)) continue;
    Eigen::Matrix<double, D, 2> columns;
    columns << per_normal[g], per_tangential[g];
    products += columns.transpose() * columns;
    projections += columns.transpose() * defect[g];
  }
  Vec2 c = products.fullPivLu().solve(projections);
  if (!(c.y() >= 0)) c = {products(0, 0) > 0 ? projections.x() / products(0, 0) : 0, 0};
  if (!(c.x() >= 0))
    c = {0, products(1, 1) > 0 ? std::max(0.0, projections.y() / products(1, 1)) : 0};
  for (std::size_t g = 0; g < grains.size(); ++g)
    defect[g] -= c.x() * per_normal[g] + c.y() * per_tangential[g];
  return {c.x(), c.y()};
}

template LateDamping subtract_late_damping<2>(const Grains&, const Frame<2>&, double, double,
                                              std::vector<Vec2>&);
template LateDamping subtract_late_damping<3>(const Grains&, const Frame<3>&, double, double,
                                              std::vector<Vec3>&);

}  // namespace grseg
