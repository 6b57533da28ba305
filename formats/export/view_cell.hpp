// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/trajectory/reader.hpp"

#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace grseg {

/// The cell for three-dimensional viewers, equal in all frames so that a film does not jitter.
/// Along x it is the cell of the run. Along y, which is never periodic, it encloses the height of
/// the box (from y = 0) and all grains of one frame. Along z it is the cell of the run; for discs
/// its width is the largest diameter, centred at z = 0.
struct ViewCell {
  std::array<double, 3> low, high;  // corners of the cell, m
  bool periodic_x, periodic_z;

  double length(std::size_t axis) const { return high[axis] - low[axis]; }
};

ViewCell view_cell(const TrajectoryReader& run, std::size_t frame);

/// Vector with three components, as viewers need: a two-dimensional vector gets z = 0, the spin of
/// a disc is about z.
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

/// Components of a contact force: normal (along n = branch/|branch|) and tangential. In two
/// dimensions the tangential component is along t = (-n_y, n_x), in three it is the modulus.
template <int D>
struct ContactParts {
  Vector<D> n;
  double normal, tangential;  // N, force on grain i; normal > 0 pushes i away from j
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
