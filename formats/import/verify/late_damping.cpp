// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/verify/late_damping.hpp"

#include "formats/import/common/frame_tools.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace grseg {
namespace {

/// The force of a contact along its normal, and n cross the force.
struct Split {
  Vec3 n;
  double normal;
  Vec3 tangential;
};
std::vector<Split> split(const ContactList<3>& contacts)
{
  std::vector<Split> all;
  all.reserve(contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Vec3 n = contacts.branch[c].normalized();
    all.push_back({n, contacts.force[c].dot(n), n.cross(contacts.force[c])});
  }
  return all;
}

std::vector<Vec3> angular_accelerations(const Grains& grains, const ContactList<3>& contacts,
                                        const std::vector<Split>& forces, double inertia)
{
  std::vector<Vec3> acceleration(grains.size(), Vec3::Zero());
  const auto add = [&](std::size_t g, const Vec3& tangential) {
    if (is_mobile(grains, g))
      acceleration[g] -= tangential / (inertia * grains.mass[g] * grains.radius[g]);
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    add(row(contacts.i[c]), forces[c].tangential);
    if (contacts.j[c] >= 0) add(row(contacts.j[c]), forces[c].tangential);
  }
  return acceleration;
}

/// Largest ratio of friction to normal force: where it is reached, contacts slide.
double friction_of(const std::vector<Split>& forces)
{
  double largest = 0;
  for (const auto& force : forces)
    if (force.normal > 0) largest = std::max(largest, force.tangential.norm() / force.normal);
  return largest;
}

}  // namespace

LateDamping subtract_late_damping(const Grains& grains, const Frame<3>& frame, double step,
                                  double inertia, std::vector<Vec3>& defect)
{
  const auto& contacts = frame.contacts;
  const auto forces = split(contacts);
  const auto spin_up = angular_accelerations(grains, contacts, forces, inertia);
  const double friction = friction_of(forces);
  // The force that is missing on every grain per unit of c_n and of c_t.
  std::vector<Vec3> per_normal(grains.size(), Vec3::Zero()), per_tangential = per_normal;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = row(contacts.i[c]);
    const bool wall = contacts.j[c] < 0;
    const auto j = wall ? i : row(contacts.j[c]);
    const bool pair = !wall && is_mobile(grains, j);
    const double m = grains.mass[i];
    const double mass = pair ? m * grains.mass[j] / (m + grains.mass[j]) : m;
    const auto& force = forces[c];
    Vec3 a = frame.force[i] / m;
    Vec3 rims = grains.radius[i] * spin_up[i];
    if (pair) {
      a -= frame.force[j] / grains.mass[j];
      rims += grains.radius[j] * spin_up[j];
    }
    const bool slides = force.tangential.norm() > 0.99 * friction * std::abs(force.normal);
    const Vec3 along_n = -mass * step / 2 * a.dot(force.n) * force.n;
    Vec3 along_t = Vec3::Zero();
    if (!slides) along_t = (-mass * step / 2 * (force.n.cross(a) - rims)).cross(force.n);
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
    Eigen::Matrix<double, 3, 2> columns;
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

}  // namespace grseg
