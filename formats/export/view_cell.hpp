// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/trajectory/reader.hpp"

#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace grseg {

/// The cell for three-dimensional viewers, equal in all frames so that a film does not jitter.
/// Along x it is the cell of the run. Along y, where nothing is periodic, it extends from y = 0 or
/// the lowest grain to the height of the box or the highest grain of one frame. Along z it is the
/// cell of the run or, for discs, one largest diameter about z = 0, where all centres lie.
struct ViewCell {
  std::array<double, 3> low, high;  // m
  bool periodic_x, periodic_z;

  double length(std::size_t axis) const { return high[axis] - low[axis]; }
};

ViewCell view_cell(const TrajectoryReader& run, std::size_t frame);

/// A vector with three components, as viewers need it: a vector of the plane has z = 0, and a spin
/// in the plane is about z.
template <int D>
Vec3 in_space(const Vector<D>& v)
{
  if constexpr (D == 2)
    return {v.x(), v.y(), 0};
  else
    return v;
}
inline Vec3 spin_in_space(double spin)
{
  return {0, 0, spin};
}
inline Vec3 spin_in_space(const Vec3& spin)
{
  return spin;
}

template <int D>
std::vector<Vec3> all_in_space(const std::vector<Vector<D>>& vectors)
{
  std::vector<Vec3> out;
  out.reserve(vectors.size());
  for (const auto& v : vectors) out.push_back(in_space<D>(v));
  return out;
}

/// The force of a contact along and across n = branch/|branch|: in two dimensions along
/// t = (-n_y, n_x), in three the modulus.
template <int D>
struct ContactParts {
  Vector<D> n;
  double normal, tangential;  // N, on i; normal > 0 pushes i away from j
};

template <int D>
ContactParts<D> contact_parts(const ContactList<D>& contacts, std::size_t contact)
{
  const Vector<D> n = contacts.branch[contact].normalized();
  const Vector<D>& force = contacts.force[contact];
  if constexpr (D == 2)
    return {n, n.dot(force), n.x() * force.y() - n.y() * force.x()};
  else
    return {n, n.dot(force), n.cross(force).norm()};
}

}  // namespace grseg
